#pragma once
// Internal to src/plan: springs and hinges of all bodies as lists with the elements at each vertex, for
// methods that gather forces vertex by vertex.

#include "taut/plan/builder.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/solid.hpp"

#include <array>
#include <vector>

namespace taut {

class Refusals;

/// The elements at each vertex: entries start[v] up to start[v + 1], ascending by element.
struct Incidence
{
    std::vector<std::uint32_t> start;   ///< vertices + 1
    std::vector<std::uint32_t> entries; ///< element * corners + corner
};

/// `corners` lists `arity` vertices an element.
Incidence incidence_of(std::uint32_t vertex_count, std::span<const std::uint32_t> corners,
                       std::uint32_t arity);
/// The same of triangles that an invocation per vertex loops over. Throws Error{limit} naming the effect and
/// the first vertex that has too many.
Incidence triangles_at(const PlanBuilder& builder, std::string_view effect,
                       std::span<const std::uint32_t> corners);

/// The vertices of an element, in the order of its record.
inline std::array<std::uint32_t, 2> corners_of(const StretchElement& e) { return {e.a, e.b}; }
inline std::array<std::uint32_t, 4> corners_of(const BendElement& e)
{
    return {e.edge0, e.edge1, e.wing0, e.wing1};
}
inline std::array<std::uint32_t, 4> corners_of(const VolumeElement& e) { return e.vertex; }
inline std::array<std::uint32_t, 4> corners_of(const SolidElement& e) { return e.vertex; }

/// Those of all, element by element.
template <typename Element>
std::vector<std::uint32_t> corners_of(const std::vector<Element>& elements)
{
    std::vector<std::uint32_t> out;
    for (const Element& e : elements)
        for (const std::uint32_t v : corners_of(e))
            out.push_back(v);
    return out;
}

template <typename Element>
Incidence incidence_of(std::uint32_t vertex_count, const std::vector<Element>& elements)
{
    constexpr auto arity = static_cast<std::uint32_t>(std::tuple_size_v<decltype(corners_of(Element{}))>);
    return incidence_of(vertex_count, corners_of(elements), arity);
}

/// For methods that move by forces. Refuses bodies with rigid elements as `unsupported`, with springs that
/// are rigid because they have no length as `degenerate_rest`, with a vertex of more elements than one
/// invocation may visit as `limit`.
void refuse_rigid(const Scene& resolved, Refusals& out);

/// Springs of a body that can act (not between two held vertices), in the order of stretch_elements; in plan
/// vertices. Adds the warning "conflict" for violated ones between held vertices.
std::vector<StretchElement> acting_springs(PlanBuilder& builder, std::size_t body);
/// The same for hinges. Adds the warning "degenerate" for those without an angle at rest.
std::vector<BendElement> acting_hinges(PlanBuilder& builder, std::size_t body);

/// Those of all bodies, body by body.
std::vector<StretchElement> all_springs(PlanBuilder& builder);
std::vector<BendElement> all_hinges(PlanBuilder& builder);

} // namespace taut
