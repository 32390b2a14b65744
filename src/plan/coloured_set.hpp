#pragma once
// Internal to src/plan: constraints of one kind, from elements of every body to coloured records and passes.

#include "taut/plan/constraints.hpp"
#include "taut/plan/grouping.hpp"
#include "taut/plan/springs.hpp"

namespace taut {

/// A graph over one body's plan vertices, counted from its first, without constraints yet. Held vertices
/// conflict like others: kernels write all ends of a constraint.
ConstraintGraph body_graph(const PlanBuilder& builder, std::size_t body, std::uint32_t stride);

/// Adds multipliers (`each` reals a constraint, where options.multipliers and the plan want them) and the
/// table of grouped colours, and puts the set into the plan.
void add_set(PlanBuilder& builder, ConstraintSet& set, std::vector<std::uint32_t> table,
             const SetOptions& options, std::uint32_t each = 1);

/// Colours `elements(body)` of all bodies and adds their records (`record(real{}, element)`) as the set's
/// buffer; nothing where there are none. For elements of four vertices.
template <typename Elements, typename Record>
void prepare_set(PlanBuilder& b, const SetOptions& options, std::uint32_t multipliers_each,
                 const Elements& elements, const Record& record)
{
    using List = decltype(elements(std::size_t(0)));
    using Element = typename List::value_type;
    Coloured<Element> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const List own = elements(body);
        ConstraintGraph graph = body_graph(b, body, 4);
        for (const Element& e : own)
            for (const std::uint32_t v : corners_of(e))
                graph.vertices.push_back(v - b.plan.body_start[body]);
        // Constraints round a hub share its neighbours too, so they stay in the colouring, one after another.
        add_body(b, coloured, own, colour_greedy(graph, {0, true}));
    }
    List flat;
    std::vector<std::uint32_t> table;
    ConstraintSet set = lay_out(options.kind, std::move(coloured), flat, table);
    if (flat.empty())
        return;
    with_real(b.plan.precision, [&](auto zero) {
        using Kept = decltype(record(zero, flat.front()));
        std::vector<Kept> records;
        records.reserve(flat.size());
        for (const Element& e : flat)
            records.push_back(record(zero, e));
        set.buffer = b.add_buffer<Kept>(set.kind, set.kind + " constraints", records);
    });
    add_set(b, set, std::move(table), options, multipliers_each);
}

/// Passes of one sweep. `kernel`: that of XPBD for the set's element; all of them have the interface of
/// kernels::xpbd_spring.
void record_colours(PlanBuilder& builder, const ConstraintSet& set, std::string_view kernel,
                    std::uint32_t vertices_each, const Moment& moment);

} // namespace taut
