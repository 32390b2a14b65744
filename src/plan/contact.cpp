// Surfaces that meet: pairs are found where vertices are not where they were expected. contact_sweep.cpp
// pushes them apart.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014 (contacts as
//   constraints of positions); Tonge, Benevolenski, Voroshilov. SIGGRAPH 2012 (mass splitting). Each kernel
//   of kernels/contact says more.
// Departures: without the guarantee (guarantee.cpp) nothing forbids a crossing; what comes closer within a
//   substep than half a gap is found in the next one (docs/contact.md, "Limits").

#include "taut/plan/contact.hpp"

#include "taut/kernels/contact_corners.hpp"
#include "taut/kernels/contact_make.hpp"
#include "taut/kernels/contact_recall.hpp"
#include "taut/kernels/contact_refit.hpp"
#include "taut/kernels/contact_remember.hpp"
#include "taut/kernels/contact_scan.hpp"
#include "taut/kernels/contact_search.hpp"
#include "taut/kernels/contact_sort.hpp"
#include "taut/kernels/contact_stray.hpp"
#include "taut/kernels/contact_wake.hpp"
#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact_patch.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/plan/contact_tree.hpp"
#include "taut/runtime/base/error.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace taut {
namespace {

/// How much further than the gap the search looks, beside what motion adds: of the gap at most and at least.
constexpr double kMostSkin = 0.5, kLeastSkin = 0.125;
/// Of the least radius: how far a vertex may end a substep from where the last search expected it, before
/// there is another one. Two of them take half of a gap: what is not listed yet cannot have crossed.
constexpr double kStray = 0.5;
/// Rows that one group can scan: 128 lanes, two loops of at most half of kMaxLoopTrips each.
constexpr std::uint32_t kMostMeeting = 1u << 20;
constexpr std::uint32_t kLeastCapacity = 1u << 12;
static_assert(TAUT_CONTACT_GROUP == kGroupSize);

/// m, of each plan vertex from the first of its body: distances within a body are all that is asked.
std::vector<glm::dvec3> rest_from_first(const PlanBuilder& b)
{
    std::vector<glm::dvec3> out(b.plan.vertex_count, glm::dvec3(0));
    for (std::size_t k = 0; k < b.scene.bodies.size(); ++k)
    {
        const std::vector<glm::dvec3>& x = b.scene.bodies[k].mesh.positions;
        for (std::uint32_t v = 0; v < x.size(); ++v)
            out[b.vertex(k, v)] = x[v] - x[0];
    }
    return out;
}

std::vector<ContactLeaf> leaves_of(const PlanBuilder& b)
{
    std::vector<ContactLeaf> out;
    for (std::uint32_t body = 0; body < b.scene.bodies.size(); ++body)
        if (takes_part(b.scene, b.scene.bodies[body]))
            for (const auto& [p, q, r] : b.scene.bodies[body].mesh.triangles)
                out.push_back({{b.vertex(body, p), b.vertex(body, q), b.vertex(body, r)}, body, 0});
    out = in_tree_order(std::move(out), b.start);
    share_out(out);
    if (!wants_guarantee(b.scene)) // which lists everything that could meet
        mark_patches(out, rest_from_first(b));
    return out;
}

void check_size(const PlanBuilder& b, std::size_t triangles)
{
    if (triangles > kMostMeeting || b.plan.vertex_count > kMostMeeting)
        throw Error(ErrorCode::limit, "contact: " + std::to_string(triangles) + " triangles and " +
                                          std::to_string(b.plan.vertex_count) +
                                          " vertices; surfaces of at most " + std::to_string(kMostMeeting) +
                                          " of each can meet so far");
}

/// What the plan knows of triangles, vertices and bodies.
template <typename Real>
void add_surfaces(PlanBuilder& b, ContactBuffers& c, const std::vector<ContactLeaf>& leaves)
{
    std::vector<layout::ContactTriangle<Real>> triangles;
    for (const ContactLeaf& leaf : leaves)
        triangles.push_back({leaf.corner[0], leaf.corner[1], leaf.corner[2], leaf.body, leaf.owns});
    std::vector<layout::ContactBody<Real>> bodies;
    std::vector<glm::vec<4, Real>> rest;
    for (const glm::dvec3& x : rest_from_first(b))
        rest.emplace_back(glm::vec<3, Real>(x), Real(0));
    for (std::size_t k = 0; k < b.scene.bodies.size(); ++k)
    {
        const Body& body = b.scene.bodies[k];
        const GroupBits bits = group_bits(b.scene, body);
        for (std::uint32_t v = 0; v < body.mesh.positions.size(); ++v)
            rest[b.vertex(k, v)].w = static_cast<Real>(k);
        bodies.push_back({static_cast<Real>(radius_of(b.scene, body)),
                          static_cast<Real>(friction_of(b.scene, body)), body.contact.self, bits.group,
                          bits.meets, touching_height(b.scene, k)});
    }
    c.triangle =
        b.add_buffer<layout::ContactTriangle<Real>>(kContactEffect, "triangles that meet", triangles);
    c.body = b.add_buffer<layout::ContactBody<Real>>(kContactEffect, "bodies that meet", bodies);
    c.rest = b.add_buffer<glm::vec<4, Real>>(kContactEffect, "shapes at rest", rest);
    c.side = b.add_buffer(kContactEffect, "sides of pairs", c.capacity * sizeof(layout::ContactSide<Real>));
}

void add_lists(PlanBuilder& b, ContactBuffers& c)
{
    constexpr std::uint64_t word = sizeof(std::uint32_t);
    const std::uint64_t real = b.real_size(), pairs = c.capacity, vertices = b.plan.vertex_count;
    c.node = b.add_buffer(kContactEffect, "tree", 2 * std::uint64_t(c.leaves) * 8 * real);
    c.found = b.add_buffer(kContactEffect, "pairs of triangles",
                           (1 + TAUT_CONTACT_KEPT) * std::uint64_t(c.triangles) * word);
    c.compared = b.add_buffer(kContactEffect, "triangles compared", c.triangles * word);
    c.start =
        b.add_buffer(kContactEffect, "pairs of triangles, start", (c.triangles + std::uint64_t(1)) * word);
    const bool guarded = wants_guarantee(b.scene);
    std::vector<std::uint32_t> control(TAUT_CONTACT_WORDS, 0);
    for (const std::size_t gate : {TAUT_CONTACT_PAIR_GROUPS, TAUT_CONTACT_VERTEX_GROUPS})
        control[gate + 1] = control[gate + 2] = 1;
    for (std::size_t gate = TAUT_CONTACT_GATE_TRIANGLES; gate + 2 < control.size(); gate += 4)
        control[gate + 1] = control[gate + 2] = 1;
    c.control = b.add_buffer<std::uint32_t>(kContactEffect, "contact control", control);
    c.lost = b.add_buffer(kContactEffect, "what was left out",
                          (guarded ? TAUT_CONTACT_GUARDED_LOST_WORDS : TAUT_CONTACT_LOST_WORDS) * word);
    c.pair = b.add_buffer(kContactEffect, "pairs", pairs * sizeof(layout::ContactPair<float>));
    c.row = b.add_buffer(kContactEffect, "weights of pairs", pairs * 8 * real);
    c.taken = b.add_buffer(kContactEffect, "multipliers of pairs", pairs * 8 * real);
    c.known = b.add_buffer(kContactEffect, "pairs of the search before",
                           pairs * sizeof(layout::ContactPair<float>));
    c.memory = b.add_buffer(kContactEffect, "friction of the search before", pairs * 8 * real);
    c.impulse = b.add_buffer(kContactEffect, "impulses of pairs", pairs * 4 * real);
    c.corners = b.add_buffer(kContactEffect, "corners at vertices", vertices * word);
    c.placed = b.add_buffer(kContactEffect, "corners placed", vertices * word);
    c.corner_start = b.add_buffer(kContactEffect, "corners at vertices, start", (vertices + 1) * word);
    c.corner = b.add_buffer(kContactEffect, "corners of pairs", 4 * pairs * word);
    c.active = b.add_buffer(kContactEffect, "active pairs at vertices", vertices * word);
    with_real(b.plan.precision, [&](auto zero) {
        using Vec = glm::vec<4, decltype(zero)>;
        std::vector<Vec> nowhere(2 * vertices, Vec(0)); // and still
        for (std::size_t v = 0; v < vertices; ++v)
            nowhere[2 * v] = Vec(kBeforeSearch);
        c.place = b.add_buffer<Vec>(kContactEffect, "places at the search", nowhere);
    });
}

std::uint32_t capacity_for(const PlanBuilder& b, std::size_t triangles)
{
    const std::uint32_t asked = b.options.contact_capacity;
    const auto usual =
        std::max<std::uint32_t>(kLeastCapacity, leaves_for(static_cast<std::uint32_t>(2 * triangles)));
    return std::min(asked > 0 ? asked : usual, kMostContactPairs);
}

/// m: how far the corners of a body's triangles are from the opposite sides, at rest: a quarter of them less.
double altitude_of(const Mesh& mesh)
{
    std::vector<double> altitudes;
    for (const auto& [p, q, r] : mesh.triangles)
    {
        const glm::dvec3 a = mesh.positions[p], b = mesh.positions[q], c = mesh.positions[r];
        const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        altitudes.push_back(longest > 0 ? glm::length(glm::cross(b - a, c - a)) / longest : 0);
    }
    const auto quarter = altitudes.begin() + static_cast<std::ptrdiff_t>(altitudes.size() / 4);
    std::nth_element(altitudes.begin(), quarter, altitudes.end());
    return *quarter;
}

/// m: half the gap; of a surface that meets itself no more than half of what its triangles are higher than
/// the gap, so that at rest none lists its neighbours, as long as that leaves an eighth of the gap.
double skin_for(const Scene& scene, double radius)
{
    double skin = kMostSkin * 2 * radius;
    for (const Body& body : scene.bodies)
    {
        if (!takes_part(scene, body) || !body.contact.self)
            continue;
        const double gap = 2 * radius_of(scene, body), room = 0.5 * (altitude_of(body.mesh) - gap);
        if (room >= kLeastSkin * gap)
            skin = std::min(skin, room);
    }
    return skin;
}

/// m: how far a vertex may end a substep from where its search expected it; with the guarantee half of what
/// guarantee_anchor allows for beside the forecast.
double stray_for(const Scene& scene, double least_radius, double skin)
{
    if (wants_guarantee(scene))
        return 0.5 * (TAUT_GUARANTEE_ROOM / 100.0) * (2 * least_radius + skin);
    return kStray * least_radius;
}

std::uint32_t refit_groups(std::uint32_t level)
{
    return level / std::min<std::uint32_t>(level, TAUT_CONTACT_REFIT);
}

/// Counts vertices that are not where the last search expected them.
void record_stray(PlanBuilder& b, const ContactBuffers& c)
{
    const bool guarded = wants_guarantee(b.scene);
    kernels::contact_stray::Bindings<Use> uses = {
        .position = {b.plan.position}, .delta = {b.plan.delta}, .place = {c.place, 2}, .lost = {c.lost, 0}};
    if (!guarded)
        uses.control = {c.control, 0};
    b.dispatch(kContactEffect, guarded ? "guarded" : "", uses, {b.plan.vertex_count, c.every, c.stray},
               b.plan.vertex_count);
}

void record_wake(PlanBuilder& b, const ContactBuffers& c)
{
    const auto groups = [](std::uint32_t count) { return (count + kGroupSize - 1) / kGroupSize; };
    std::array<std::uint32_t, TAUT_CONTACT_MOST_LEVELS> levels = {refit_groups(c.leaves)};
    for (std::size_t k = 1; k < levels.size(); ++k)
        levels[k] = levels[k - 1] > 1 ? refit_groups(levels[k - 1]) : 0;
    const kernels::contact_wake::Bindings<Use> uses = {.lost = {c.lost, 0}, .control = {c.control}};
    b.dispatch(
        kContactEffect, "", uses,
        {1, groups(c.triangles), groups(b.plan.vertex_count), levels[0], levels[1], levels[2], levels[3]}, 1);
}

void record_refit(PlanBuilder& b, const ContactBuffers& c)
{
    const kernels::contact_refit::Bindings<Use> leaves = {.node = {c.node, 2},
                                                          .triangle = {c.triangle},
                                                          .position = {b.plan.position, 3},
                                                          .delta = {b.plan.delta, 3}};
    const kernels::contact_refit::Bindings<Use> nodes = {.node = {c.node, 2}};
    const std::string_view variant = wants_guarantee(b.scene) ? "guarded" : "leaves";
    std::uint64_t gate = TAUT_CONTACT_GATE_LEVELS;
    gated(b, variant, leaves, {c.leaves, c.triangles, c.every}, refit_groups(c.leaves), gate);
    for (std::uint32_t level = refit_groups(c.leaves); level > 1; level = refit_groups(level))
        gated(b, "", nodes, {level, c.triangles, c.every}, refit_groups(level), gate += 4);
}

void record_lists(PlanBuilder& b, const ContactBuffers& c)
{
    const std::uint32_t n = c.triangles, vertices = b.plan.vertex_count;
    kernels::contact_search::Bindings<Use> count = {.triangle = {c.triangle},
                                                    .position = {b.plan.position, 3},
                                                    .delta = {b.plan.delta, 3},
                                                    .node = {c.node, 2},
                                                    .body = {c.body}};
    kernels::contact_search::Bindings<Use> fill = count;
    count.found = {c.found, 1 + TAUT_CONTACT_KEPT};
    count.compared = {c.compared};
    count.lost = {c.lost, 0};
    fill.start = {c.start, 2};
    fill.found = {c.found, 1 + TAUT_CONTACT_KEPT};
    fill.pair = {c.pair};
    const kernels::contact_search::Bindings<Use>::Params how = {n,      c.leaves, c.every,
                                                                c.skin, c.reach,  c.capacity};
    const kernels::contact_remember::Bindings<Use> remember = {.start = {c.corner_start, 2},
                                                               .corner = {c.corner, 4},
                                                               .pair = {c.pair},
                                                               .side = {c.side, 2},
                                                               .known = {c.known},
                                                               .memory = {c.memory, 2}};
    gated(b, "", remember, {vertices}, vertices, TAUT_CONTACT_GATE_VERTICES);
    const bool guarded = wants_guarantee(b.scene);
    gated(b, guarded ? "guarded" : "", count, how, n, TAUT_CONTACT_GATE_TRIANGLES);
    kernels::contact_scan::Bindings<Use> rows = {
        .found = {c.found, n}, .start = {c.start, n}, .compared = {c.compared, n}, .control = {c.control}};
    if (guarded)
        rows.lost = {c.lost, 0};
    gated(b, guarded ? "guarded_rows" : "rows", rows, {n, c.capacity, vertices}, 1, TAUT_CONTACT_GATE_ONE);
    gated(b, guarded ? "guarded_fill" : "fill", fill, how, n, TAUT_CONTACT_GATE_TRIANGLES);
    const kernels::contact_make::Bindings<Use> make = {.pair = {c.pair},
                                                       .position = {b.plan.position, 4},
                                                       .rest = {c.rest, 4},
                                                       .body = {c.body, 2},
                                                       .control = {c.control, 0},
                                                       .side = {c.side},
                                                       .corners = {c.corners, 4}};
    const glm::vec3 up(upwards(b.scene));
    const float blur = b.plan.precision == Precision::float32 ? 0x1p-22f : 0x1p-51f;
    gated(b, "", make, {c.capacity, friction_mix_of(b.scene), blur, up.x, up.y, up.z}, c.capacity,
          TAUT_CONTACT_GATE_PAIRS);
    const kernels::contact_recall::Bindings<Use> recall = {.pair = {c.pair},
                                                           .control = {c.control, 0},
                                                           .start = {c.corner_start, 2},
                                                           .corner = {c.corner, 4},
                                                           .known = {c.known, 4},
                                                           .memory = {c.memory, 2},
                                                           .side = {c.side, 2}};
    gated(b, "", recall, {c.capacity}, c.capacity, TAUT_CONTACT_GATE_PAIRS);
    const kernels::contact_scan::Bindings<Use> places = {.found = {c.corners, vertices},
                                                         .start = {c.corner_start, vertices}};
    gated(b, "", places, {vertices, 0, vertices}, 1, TAUT_CONTACT_GATE_ONE);
    const kernels::contact_corners::Bindings<Use> corners = {.pair = {c.pair},
                                                             .control = {c.control, 0},
                                                             .start = {c.corner_start, 4},
                                                             .corner = {c.corner, 4},
                                                             .taken = {c.placed, 4}};
    gated(b, "", corners, {c.capacity}, c.capacity, TAUT_CONTACT_GATE_PAIRS);
    const kernels::contact_sort::Bindings<Use> sort = {.start = {c.corner_start, 2},
                                                       .corner = {c.corner},
                                                       .corners = {c.corners},
                                                       .taken = {c.placed},
                                                       .lost = {c.lost, 0}};
    gated(b, "", sort, {vertices}, vertices, TAUT_CONTACT_GATE_VERTICES);
    const kernels::contact_stray::Bindings<Use> keep = {
        .position = {b.plan.position}, .delta = {b.plan.delta}, .place = {c.place, 2}};
    gated(b, "keep", keep, {vertices, c.every, c.stray}, vertices, TAUT_CONTACT_GATE_VERTICES);
}

} // namespace

void prepare_contact(PlanBuilder& b)
{
    const std::vector<ContactLeaf> leaves = leaves_of(b);
    check_size(b, leaves.size());
    b.contact = std::make_shared<ContactBuffers>();
    ContactBuffers& c = *b.contact;
    c.triangles = static_cast<std::uint32_t>(leaves.size());
    c.leaves = leaves_for(c.triangles);
    c.capacity = capacity_for(b, leaves.size());
    const std::uint32_t searches = std::min(b.scene.contact.searches, b.plan.substeps);
    c.every = (b.plan.substeps + searches - 1) / searches;
    double radius = 0, least = std::numeric_limits<double>::infinity();
    for (const Body& body : b.scene.bodies)
        if (takes_part(b.scene, body))
        {
            radius = std::max(radius, radius_of(b.scene, body));
            least = std::min(least, radius_of(b.scene, body));
        }
    const double time = b.plan.timestep / b.plan.substeps * c.every;
    const double fall = 0.5 * glm::length(b.scene.gravity) * time * time;
    c.skin = static_cast<float>(skin_for(b.scene, radius) + fall);
    c.stray = static_cast<float>(stray_for(b.scene, least, static_cast<double>(c.skin)));
    c.reach = static_cast<float>(2 * radius + static_cast<double>(c.skin)) * 1.0001f; // rounded up
    with_real(b.plan.precision, [&](auto zero) { add_surfaces<decltype(zero)>(b, c, leaves); });
    add_lists(b, c);
    b.plan.contact = {c.control,      c.lost,     c.pair,
                      c.side,         c.taken,    c.place,
                      c.triangles,    c.capacity, wants_guarantee(b.scene),
                      c.corner_start, c.corner};
}

void record_contact_search(PlanBuilder& b, const Moment&)
{
    record_stray(b, *b.contact);
    record_wake(b, *b.contact);
    record_refit(b, *b.contact);
    record_lists(b, *b.contact);
}

} // namespace taut
