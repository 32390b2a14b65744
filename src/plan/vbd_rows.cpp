// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024.
// Departures: every element stands once in the list of each of its vertices, so that a row reads its own in a
//   row; a tetrahedron is turned so that its own vertex comes second, whose gradients need no search.
#include "taut/plan/vbd_rows.hpp"

#include "taut/plan/records.hpp"
#include "taut/plan/solid_constraints.hpp"

#include <glm/matrix.hpp>

#include <algorithm>

namespace taut {
namespace {

template <typename Element>
void append(std::vector<Element>& to, const std::vector<Element>& more)
{
    to.insert(to.end(), more.begin(), more.end());
}

/// A tetrahedron as it stands in the list of its corner `own`: that one second, and right-handed.
std::array<std::uint32_t, 4> seen_from(std::uint32_t own, const std::array<std::uint32_t, 4>& v)
{
    constexpr std::array<std::uint32_t, 4> orders[] = {
        {3, 0, 2, 1}, {0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}};
    const auto& order = orders[own];
    return {v[order[0]], v[order[1]], v[order[2]], v[order[3]]};
}

/// The rows of B of the corners b, c, d; that of a makes the sum of all four zero.
glm::dmat3 rest_seen_from(std::uint32_t own, const glm::dmat3& inverse_rest)
{
    const glm::dmat3 rows = glm::transpose(inverse_rest); // by columns: rows of B
    const std::array<glm::dvec3, 4> corner = {-(rows[0] + rows[1] + rows[2]), rows[0], rows[1], rows[2]};
    const auto order = seen_from(own, {0, 1, 2, 3});
    return glm::transpose(glm::dmat3(corner[order[1]], corner[order[2]], corner[order[3]]));
}

VolumeElement seen_from(std::uint32_t own, VolumeElement e)
{
    e.vertex = seen_from(own, e.vertex);
    return e;
}

SolidElement seen_from(std::uint32_t own, SolidElement e)
{
    e.vertex = seen_from(own, e.vertex);
    e.inverse_rest = rest_seen_from(own, e.inverse_rest);
    return e;
}

/// Hinges and held volumes in one kind of record, or in that of elastic tetrahedra where there are such.
template <typename Real>
struct PlainCorner
{
    using Record = layout::BendingConstraint<Real>;
    static Record of(const BendElement& e) { return bending_record<Real>(e); }
    static Record of(const VolumeElement& e)
    {
        return {e.vertex[0],
                e.vertex[1],
                e.vertex[2],
                e.vertex[3],
                static_cast<Real>(e.rest_volume),
                static_cast<Real>(e.compliance)};
    }
    static Record of(const SolidElement&) { return {}; } // there are none
};

template <typename Real>
struct ElasticCorner
{
    using Record = layout::SolidTetrahedron<Real>;
    static Record of(const BendElement& e)
    {
        Record out = {};
        out.a = e.edge0;
        out.b = e.edge1;
        out.c = e.wing0;
        out.d = e.wing1;
        out.b00 = static_cast<Real>(e.rest_angle);
        out.b01 = static_cast<Real>(e.compliance);
        return out;
    }
    static Record of(const SolidElement& e) { return solid_record<Real>(e); }
    static Record of(const VolumeElement& e) // (V - V0)^2 / (2 c) = V0 lambda / 2 (J - 1)^2
    {
        SolidElement same;
        same.vertex = e.vertex;
        same.inverse_rest = glm::dmat3(0);
        same.rest_volume = e.rest_volume;
        same.lambda = e.rest_volume / e.compliance;
        same.log = 0;
        return solid_record<Real>(same);
    }
};

/// The lists of all rows, and where each row's part begins: four numbers a row.
template <typename Real, typename Corner>
struct Lists
{
    std::vector<layout::Spring<Real>> ends;
    std::vector<typename Corner::Record> hinges, tetrahedra;

    void add(const BlockElements& elements, std::uint32_t v)
    {
        const auto visit = [v](const auto& all, const Incidence& at, std::uint32_t arity, const auto& each) {
            for (std::uint32_t k = at.start[v]; k < at.start[v + 1]; ++k)
                each(all[at.entries[k] / arity], at.entries[k] % arity);
        };
        visit(elements.springs, elements.at_spring, 2, [&](const StretchElement& e, std::uint32_t own) {
            ends.push_back(spring_record<Real>(e));
            if (own == 1)
                std::swap(ends.back().a, ends.back().b);
        });
        visit(elements.hinges, elements.at_hinge, 4,
              [&](const BendElement& e, std::uint32_t) { hinges.push_back(Corner::of(e)); });
        const auto turned = [&](const auto& e, std::uint32_t own) {
            tetrahedra.push_back(Corner::of(seen_from(own, e)));
        };
        visit(elements.volumes, elements.at_volume, 4, turned);
        visit(elements.solids, elements.at_solid, 4, turned);
    }
};

template <typename Real, typename Corner>
void add_lists(PlanBuilder& b, BlockBuffers& f, const BlockElements& elements,
               const std::vector<std::vector<std::uint32_t>>& colours)
{
    Lists<Real, Corner> lists;
    std::vector<std::uint32_t> row;
    std::vector<GuardedRow> row_of(b.plan.vertex_count);
    const auto mark = [&](std::uint32_t vertex, std::uint32_t end) {
        row.insert(row.end(), {vertex, static_cast<std::uint32_t>(lists.ends.size()),
                               static_cast<std::uint32_t>(lists.hinges.size()), end});
        if (f.tetrahedra())
            row.push_back(static_cast<std::uint32_t>(lists.tetrahedra.size()));
    };
    std::uint32_t colour_end = 0;
    for (const auto& colour : colours)
    {
        colour_end += static_cast<std::uint32_t>(colour.size());
        for (const std::uint32_t v : colour)
        {
            row_of[v] = {static_cast<std::uint32_t>(row.size() / f.row_words()), elements.at(v)};
            mark(v, colour_end);
            lists.add(elements, v);
        }
    }
    mark(0, colour_end); // the end of the last row's elements
    const std::size_t words = f.row_words();
    for (std::size_t k = 4; f.tetrahedra() && k < row.size(); k += words) // they stand behind the hinges
        row[k] += static_cast<std::uint32_t>(lists.hinges.size());
    const auto each = [&](std::size_t count) {
        return static_cast<std::uint32_t>(count / std::max(f.rows, 1u) + 1);
    };
    f.springs_each = each(lists.ends.size());
    f.hinges_each = each(lists.hinges.size());
    f.tetrahedra_each = each(lists.tetrahedra.size());
    if (lists.ends.empty())
        lists.ends.push_back({}); // never read
    f.table = static_cast<std::uint32_t>(row.size());
    append(row, guard_table(b, f, row_of));
    f.row = b.add_buffer<std::uint32_t>("vbd_solve", "rows", row);
    f.ends = b.add_buffer<layout::Spring<Real>>("vbd_solve", "spring ends", lists.ends);
    append(lists.hinges, lists.tetrahedra);
    if (lists.hinges.empty())
        lists.hinges.push_back({}); // never read
    if (f.hinges || f.tetrahedra())
        f.corners = b.add_buffer<typename Corner::Record>(
            "vbd_solve", f.tetrahedra() ? "corners of hinges and tetrahedra" : "hinge corners", lists.hinges);
}

} // namespace

BlockElements elements_of(PlanBuilder& b)
{
    BlockElements out;
    out.springs = all_springs(b);
    out.hinges = all_hinges(b);
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        append(out.volumes, acting_volumes(b, body));
        append(out.solids, acting_solids(b, body));
    }
    out.added = added_sets(b);
    for (const AddedSet& set : out.added)
        out.at_added.push_back(incidence_of(b.plan.vertex_count, set.vertices, set.kind->corners));
    out.at_spring = incidence_of(b.plan.vertex_count, out.springs);
    out.at_hinge = incidence_of(b.plan.vertex_count, out.hinges);
    out.at_volume = incidence_of(b.plan.vertex_count, out.volumes);
    out.at_solid = incidence_of(b.plan.vertex_count, out.solids);
    return out;
}

void add_rows(PlanBuilder& b, BlockBuffers& f, const BlockElements& elements,
              const std::vector<std::vector<std::uint32_t>>& colours)
{
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        if (f.elastic)
            add_lists<Real, ElasticCorner<Real>>(b, f, elements, colours);
        else
            add_lists<Real, PlainCorner<Real>>(b, f, elements, colours);
    });
}

} // namespace taut
