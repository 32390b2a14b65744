// Based on: Provot 1995 and Kim, Chentanez, Mueller-Fischer 2012, as their kernels say.
// Departures: distances to pins are along edges, never shorter than along the cloth, so an attachment
//   forbids nothing that the cloth at rest allows.

#include "taut/plan/limits.hpp"

#include "taut/plan/grouping.hpp"
#include "taut/plan/records.hpp"
#include "taut/kernels/attachment.hpp"
#include "taut/kernels/strain_limit.hpp"
#include "taut/kernels/tearing.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace taut {
namespace {

constexpr std::string_view kStrain = "strain_limit";

/// Springs of a body that can be too long, in plan vertices, each with its greatest length for a rest length.
/// Between two held vertices nothing can be done; without a length there is no strain.
std::vector<StretchElement> limited_springs(const PlanBuilder& b, std::size_t body, double strain)
{
    std::vector<StretchElement> out;
    for (StretchElement e : stretch_elements(b.scene.bodies[body]))
    {
        e.a = b.vertex(body, e.a);
        e.b = b.vertex(body, e.b);
        e.rest_length *= 1 + strain;
        e.compliance = 0; // a limit does not give
        if (e.rest_length > 0 && (b.inverse_mass[e.a] > 0 || b.inverse_mass[e.b] > 0))
            out.push_back(e);
    }
    return out;
}

std::uint32_t add_springs(PlanBuilder& b, std::string_view effect, std::string_view name,
                          const std::vector<StretchElement>& springs)
{
    return with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        return b.add_buffer<layout::DistanceConstraint<Real>>(effect, name,
                                                              records_of(springs, distance_record<Real>));
    });
}

Colouring colouring_of_body(const PlanBuilder& b, std::size_t body,
                            const std::vector<StretchElement>& springs)
{
    const std::uint32_t first = b.plan.body_start[body];
    ConstraintGraph graph;
    graph.vertex_count = b.plan.body_start[body + 1] - first;
    for (const StretchElement& e : springs)
        graph.vertices.insert(graph.vertices.end(), {e.a - first, e.b - first});
    return colour_greedy(graph, {0, true}); // springs of a hub go one after another
}

bool any_springs(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), has_springs);
}

} // namespace

bool wants_strain_limit(const Scene& scene)
{
    return any_springs(scene) && std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                             [](const Body& b) { return b.material.strain_limit > 0; });
}

bool wants_attachment(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return b.material.attachment_slack &&
               std::any_of(b.pins.begin(), b.pins.end(), [](const Pin& p) { return !p.vertices.empty(); });
    });
}

bool wants_tearing(const Scene& scene)
{
    return any_springs(scene) && std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                             [](const Body& b) { return b.material.tear_strain > 0; });
}

std::vector<NearestPin> nearest_pins(const Body& body)
{
    const std::vector<glm::dvec3>& x = body.mesh.positions;
    std::vector<std::vector<std::uint32_t>> neighbours(x.size());
    each_edge(body.mesh, [&](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t>) {
        neighbours[a].push_back(b);
        neighbours[b].push_back(a);
    });
    std::vector<NearestPin> out(x.size(), {0, std::numeric_limits<double>::infinity()});
    using Place = std::pair<double, std::uint32_t>;
    std::priority_queue<Place, std::vector<Place>, std::greater<>> open;
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
        {
            out[v] = {v, 0};
            open.push({0, v});
        }
    while (!open.empty())
    {
        const auto [distance, v] = open.top();
        open.pop();
        if (distance > out[v].distance)
            continue;
        for (const std::uint32_t n : neighbours[v])
        {
            const double further = distance + glm::distance(x[v], x[n]);
            if (further < out[n].distance)
            {
                out[n] = {out[v].pin, further};
                open.push({further, n});
            }
        }
    }
    return out;
}

void prepare_strain_limit(PlanBuilder& b)
{
    Coloured<StretchElement> coloured;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        if (const double limit = b.scene.bodies[body].material.strain_limit; limit > 0)
        {
            const std::vector<StretchElement> springs = limited_springs(b, body, limit);
            add_body(b, coloured, springs, colouring_of_body(b, body, springs));
        }
    std::vector<StretchElement> flat;
    std::vector<std::uint32_t> table;
    ConstraintSet set = lay_out(kStrain, std::move(coloured), flat, table);
    if (flat.empty())
        return;
    set.buffer = add_springs(b, kStrain, "strain limits", flat);
    add_colour_table(b, set, std::move(table));
    b.limits = std::move(set);
}

void record_strain_limit(PlanBuilder& b, const Moment&)
{
    const ConstraintSet& set = b.limits;
    if (set.count == 0)
        return;
    const kernels::strain_limit::Bindings<Use> alone = {
        .constraint = {set.buffer}, .position = {b.plan.position, 2}, .delta = {b.plan.delta, 2}};
    kernels::strain_limit::Bindings<Use> grouped = alone;
    grouped.table = {set.table};
    std::uint32_t range = first_run_range(set);
    for (const Run& run : runs_of(b, set))
    {
        const std::uint32_t first = set.colour_start[run.begin], size = set.colour_start[run.end] - first;
        b.stands_for(run.end - run.begin);
        if (run.grouped())
            b.dispatch(kStrain, "tail", grouped, {range, 1}, 1, size);
        else
            b.dispatch(kStrain, "", alone, {first, size}, size);
        range += run.grouped() ? 2 : 0;
    }
    if (set.small_bodies > 0)
    {
        stand_for_small(b, set);
        b.dispatch(kStrain, "tail", grouped, {set.small_range, set.small_bodies}, set.small_bodies,
                   set.small_constraints);
    }
}

void prepare_attachment(PlanBuilder& b)
{
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::Attachment<Real>> records;
        for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        {
            const Body& own = b.scene.bodies[body];
            if (!own.material.attachment_slack || own.pins.empty())
                continue;
            const std::vector<NearestPin> nearest = nearest_pins(own);
            for (std::uint32_t v = 0; v < nearest.size(); ++v)
                if (nearest[v].distance > 0 && nearest[v].distance < std::numeric_limits<double>::infinity())
                    records.push_back(
                        {b.vertex(body, v), b.vertex(body, nearest[v].pin),
                         static_cast<Real>((1 + *own.material.attachment_slack) * nearest[v].distance)});
        }
        b.attachment_count = static_cast<std::uint32_t>(records.size());
        if (!records.empty())
            b.attachments = b.add_buffer<layout::Attachment<Real>>("attachment", "attachments", records);
    });
}

void record_attachment(PlanBuilder& b, const Moment&)
{
    if (b.attachment_count == 0)
        return;
    const kernels::attachment::Bindings<Use> uses = {
        .attachment = {b.attachments}, .position = {b.plan.position, 2}, .delta = {b.plan.delta, 2}};
    b.dispatch("attachment", "", uses, {b.attachment_count}, b.attachment_count);
}

void prepare_tearing(PlanBuilder& b)
{
    std::vector<StretchElement> springs;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
        if (const double strain = b.scene.bodies[body].material.tear_strain; strain > 0)
            for (const StretchElement& e : limited_springs(b, body, strain))
                springs.push_back(e);
    b.tearing_count = static_cast<std::uint32_t>(springs.size());
    if (springs.empty())
        return;
    b.tearing = add_springs(b, "tearing", "lengths at which springs tear", springs);
    b.plan.torn = b.add_buffer("tearing", "springs beyond it", sizeof(std::uint32_t));
}

void record_tearing(PlanBuilder& b, const Moment& moment)
{
    if (b.tearing_count == 0 || moment.substep + 1 < b.plan.substeps)
        return;
    const kernels::tearing::Bindings<Use> uses = {
        .spring = {b.tearing}, .position = {b.plan.position, 2}, .torn = {b.plan.torn, 0}};
    b.dispatch("tearing", "", uses, {b.tearing_count}, b.tearing_count);
}

} // namespace taut
