// Position-based dynamics: what it refuses, its coloured sweeps, its Jacobi iterations.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006: stiffness as the
//   share k' = 1 - (1 - k)^(1/n) of a correction.
//   Fratarcangeli, Pellacini. Scalable Partitioning for Parallel Position Based Dynamics. 2015: colours.
//   Wang. A Chebyshev Semi-Iterative Approach. 2015: Chebyshev's weights.
// Departures: Jacobi hands its iterates from buffer to buffer; the plan's `delta` is always the newer one, so
//   contacts and the end of the substep read what the last iteration wrote, and nothing is copied.

#include "taut/plan/pbd.hpp"

#include "taut/kernels/pbd_average.hpp"
#include "taut/kernels/pbd_hub_spring.hpp"
#include "taut/kernels/pbd_node.hpp"
#include "taut/kernels/pbd_spring.hpp"
#include "taut/plan/coloured_set.hpp"
#include "taut/plan/records.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/solid_constraints.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr std::uint32_t kPlainPbdIterations = 4; ///< before Chebyshev's weights begin
constexpr std::uint32_t kLeastChebyshev = 8;   ///< iterations below which the weights do harm

constexpr std::string_view kJacobi = "pbd_jacobi";

void record_pbd_hubs(PlanBuilder& b, const ConstraintSet& set, const Moment& moment)
{
    const MethodSettings& m = b.scene.method;
    const auto share = static_cast<float>(pbd_share(m.stretch, b.plan.iterations) * m.relaxation);
    const kernels::pbd_hub_spring::Bindings<Use> uses = {.constraint = {set.buffer},
                                                         .position = {b.plan.position, 2},
                                                         .delta = {b.plan.delta, 2},
                                                         .events = {b.plan.events, 0}};
    for (std::size_t h = 0; h + 1 < set.hub_start.size(); ++h)
    {
        const std::uint32_t size = set.hub_start[h + 1] - set.hub_start[h];
        b.dispatch(set.kind, "", uses, {set.hub_start[h], size, share, moment.last}, 1, size);
    }
}

/// What the Jacobi schemes solve.
struct JacobiElements
{
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<VolumeElement> volumes;
};

JacobiElements jacobi_elements(PlanBuilder& b)
{
    const MethodSettings& m = b.scene.method;
    JacobiElements out;
    if (m.stretch > 0)
        out.springs = all_springs(b);
    if (m.bend > 0)
        out.hinges = all_hinges(b);
    for (std::size_t body = 0; m.volume > 0 && body < b.scene.bodies.size(); ++body)
        for (const VolumeElement& e : acting_volumes(b, body))
            out.volumes.push_back(e);
    return out;
}

/// Adds, for each vertex, where its entries begin in the list, then the entries. Returns where that begins.
std::uint32_t append_list(std::vector<std::uint32_t>& list, const Incidence& at)
{
    const auto begin = static_cast<std::uint32_t>(list.size());
    const auto first = begin + static_cast<std::uint32_t>(at.start.size());
    for (const std::uint32_t start : at.start)
        list.push_back(first + start);
    list.insert(list.end(), at.entries.begin(), at.entries.end());
    return begin;
}

/// A vertex goes through its constraints in one invocation.
void check_degree(const PlanBuilder& b, std::span<const Incidence> lists)
{
    for (std::uint32_t v = 0; v < b.plan.vertex_count; ++v)
    {
        std::uint32_t degree = 0;
        for (const Incidence& at : lists)
            degree += at.start[v + 1] - at.start[v];
        if (degree > kMaxLoopTrips)
            throw Error(ErrorCode::limit, "method.scheme is " + quoted(b.scene.method.scheme) +
                                              ", but a vertex has " + std::to_string(degree) +
                                              " springs, hinges and tetrahedra; the Jacobi schemes of pbd "
                                              "take at most " +
                                              std::to_string(kMaxLoopTrips) +
                                              "; use method.scheme \"coloured\"");
    }
}

/// What stands at each vertex, in one buffer: springs, then hinges and tetrahedra where there are any.
void add_incidence(PlanBuilder& b, const JacobiElements& of)
{
    const std::uint32_t n = b.plan.vertex_count;
    const Incidence lists[] = {incidence_of(n, of.springs), incidence_of(n, of.hinges),
                               incidence_of(n, of.volumes)};
    check_degree(b, lists);
    std::vector<std::uint32_t> words;
    append_list(words, lists[0]);
    if (!of.hinges.empty())
        b.pbd.hinges_at = append_list(words, lists[1]);
    if (!of.volumes.empty())
        b.pbd.volumes_at = append_list(words, lists[2]);
    b.pbd.at = b.add_buffer<std::uint32_t>(kJacobi, "constraints at a vertex", words);
}

void add_jacobi_records(PlanBuilder& b, const JacobiElements& of)
{
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        auto stretch = records_of(of.springs, distance_record<Real>);
        stretch.resize(std::max<std::size_t>(stretch.size(), 1)); // hinges alone: no buffer is empty
        b.pbd.springs = b.add_buffer<layout::DistanceConstraint<Real>>(kJacobi, "springs", stretch);
        const auto bend = records_of(of.hinges, bending_record<Real>);
        if (!bend.empty())
            b.pbd.hinges = b.add_buffer<layout::BendingConstraint<Real>>(kJacobi, "hinges", bend);
        const auto volume = records_of(of.volumes, volume_record<Real>);
        if (!volume.empty())
            b.pbd.volumes = b.add_buffer<layout::VolumeConstraint<Real>>(kJacobi, "tetrahedra", volume);
    });
}

struct Shares
{
    float stretch, bend, volume;
};

Shares shares_of(const PlanBuilder& b)
{
    const MethodSettings& m = b.scene.method;
    return {static_cast<float>(pbd_share(m.stretch, b.plan.iterations)),
            static_cast<float>(pbd_share(m.bend, b.plan.iterations)),
            static_cast<float>(pbd_share(m.volume, b.plan.iterations))};
}

/// What one kind of element wants, into its slots.
struct SlotPass
{
    std::string_view kernel;
    std::uint32_t constraints, slots; ///< buffers
    std::uint32_t corners, slots_each, count;
    float share;
};

void record_slots(PlanBuilder& b, const Shares& shares, std::uint32_t report)
{
    const PbdBuffers& p = b.pbd;
    const SlotPass passes[] = {
        {"pbd_spring", p.springs, p.spring_slots, 2, 1, p.spring_count, shares.stretch},
        {"pbd_hinge", p.hinges, p.hinge_slots, 4, 4, p.hinge_count, shares.bend},
        {"pbd_volume", p.volumes, p.volume_slots, 4, 4, p.volume_count, shares.volume},
    };
    for (const SlotPass& pass : passes)
    {
        if (pass.constraints == kNoBuffer)
            continue;
        const kernels::pbd_spring::Bindings<Use> uses = {.constraint = {pass.constraints},
                                                         .position = {b.plan.position, pass.corners},
                                                         .delta = {b.plan.delta, pass.corners},
                                                         .events = {b.plan.events, 0},
                                                         .correction = {pass.slots, pass.slots_each}};
        b.dispatch_by_name(kJacobi, pass.kernel, "slots", uses, {0, pass.count, pass.share, report},
                           pass.count);
    }
}

/// The variant of pbd_node and pbd_average for what a scene has.
std::string jacobi_variant(const PbdBuffers& pbd, bool chebyshev)
{
    std::string variant;
    for (const auto& [used, word] : {std::pair{pbd.hinges != kNoBuffer, "hinges"},
                                     std::pair{pbd.volumes != kNoBuffer, "volumes"},
                                     std::pair{chebyshev, "chebyshev"}})
        if (used)
            variant += (variant.empty() ? "" : "_") + std::string(word);
    return variant;
}

} // namespace

bool pbd_is_coloured(const Scene& scene)
{
    return scene.method.scheme == ElementScheme::automatic || scene.method.scheme == ElementScheme::coloured;
}

double pbd_share(double stiffness, std::uint32_t iterations)
{
    return 1 - std::pow(1 - stiffness, 1.0 / iterations);
}

double chebyshev_weight(double spectral_radius, std::uint32_t iteration)
{
    if (!(spectral_radius > 0) || iteration < kPlainPbdIterations)
        return 1;
    const double square = spectral_radius * spectral_radius;
    double weight = 2 / (2 - square);
    for (std::uint32_t i = kPlainPbdIterations; i < iteration; ++i)
        weight = 4 / (4 - square * weight);
    return weight;
}

void check_pbd(const Scene& scene, Refusals& out)
{
    const MethodSettings& m = scene.method;
    out.attempt_bodies(scene, [](const Body& body, std::size_t k) {
        if (body.material.stretch_damping > 0)
            throw Error(ErrorCode::unsupported,
                        "bodies[" + std::to_string(k) + "].material.stretch_damping is " +
                            shown(body.material.stretch_damping) +
                            " s; pbd has no damper along springs; use damping of the scene, or another "
                            "method");
    });
    if (!(m.spectral_radius > 0))
        return;
    out.attempt([&] {
        const std::string where = "method.spectral_radius is " + shown(m.spectral_radius);
        if (pbd_is_coloured(scene))
            throw Error(ErrorCode::unsupported,
                        where + "; Chebyshev's acceleration of pbd needs method.scheme \"node_centric\" or "
                                "\"constraint_centric\"");
        if (m.iterations < kLeastChebyshev)
            throw Error(ErrorCode::unsupported,
                        where + " with " + std::to_string(m.iterations) +
                            " iterations; Chebyshev's acceleration diverges with fewer than " +
                            std::to_string(kLeastChebyshev) + "; use more, or 0");
    });
}

void record_pbd_sweep(PlanBuilder& b, const ConstraintSet& set, std::string_view kernel,
                      std::uint32_t vertices_each, double stiffness, const Moment& moment)
{
    const auto share =
        static_cast<float>(pbd_share(stiffness, b.plan.iterations) * b.scene.method.relaxation);
    const std::uint32_t report = moment.last;
    const kernels::pbd_spring::Bindings<Use> alone = {.constraint = {set.buffer},
                                                      .position = {b.plan.position, vertices_each},
                                                      .delta = {b.plan.delta, vertices_each},
                                                      .events = {b.plan.events, 0}};
    kernels::pbd_spring::Bindings<Use> grouped = alone;
    grouped.table = {set.table};
    std::uint32_t range = first_run_range(set);
    for (const Run& run : runs_of(b, set))
    {
        const std::uint32_t first = set.colour_start[run.begin], size = set.colour_start[run.end] - first;
        b.stands_for(run.end - run.begin);
        if (run.grouped())
            b.dispatch_by_name(set.kind, kernel, "tail", grouped, {range, 1, share, report}, 1, size);
        else
            b.dispatch_by_name(set.kind, kernel, "", alone, {first, size, share, report}, size);
        range += run.grouped() ? 2 : 0;
    }
    if (set.small_bodies > 0)
    {
        stand_for_small(b, set);
        b.dispatch_by_name(set.kind, kernel, "tail", grouped,
                           {set.small_range, set.small_bodies, share, report}, set.small_bodies,
                           set.small_constraints);
    }
}

void prepare_pbd_stretch(PlanBuilder& b)
{
    prepare_springs(b, {"pbd_stretch", false, ColouringOptions{}.hub_degree});
}

void prepare_pbd_bend(PlanBuilder& b) { prepare_hinges(b, {"pbd_bend"}); }

void prepare_pbd_volume(PlanBuilder& b)
{
    prepare_set(
        b, {"pbd_volume"}, 1, [&](std::size_t body) { return acting_volumes(b, body); },
        [](auto zero, const VolumeElement& e) { return volume_record<decltype(zero)>(e); });
}

void record_pbd_stretch(PlanBuilder& b, const Moment& moment)
{
    const ConstraintSet* set = find_set(b.plan, "pbd_stretch");
    if (set == nullptr)
        return;
    record_pbd_sweep(b, *set, "pbd_spring", 2, b.scene.method.stretch, moment);
    record_pbd_hubs(b, *set, moment);
}

void record_pbd_bend(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "pbd_bend"))
        record_pbd_sweep(b, *set, "pbd_hinge", 4, b.scene.method.bend, moment);
}

void record_pbd_volume(PlanBuilder& b, const Moment& moment)
{
    if (const ConstraintSet* set = find_set(b.plan, "pbd_volume"))
        record_pbd_sweep(b, *set, "pbd_volume", 4, b.scene.method.volume, moment);
}

void prepare_pbd_jacobi(PlanBuilder& b)
{
    const JacobiElements of = jacobi_elements(b);
    if (of.springs.empty() && of.hinges.empty() && of.volumes.empty())
        return;
    b.pbd.spring_count = static_cast<std::uint32_t>(of.springs.size());
    b.pbd.hinge_count = static_cast<std::uint32_t>(of.hinges.size());
    b.pbd.volume_count = static_cast<std::uint32_t>(of.volumes.size());
    add_incidence(b, of);
    add_jacobi_records(b, of);
    const std::uint64_t vector = 4 * b.real_size();
    b.pbd.other = b.add_buffer(kJacobi, "other iterate", b.plan.vertex_count * vector);
    if (b.scene.method.scheme != ElementScheme::constraint_centric)
        return;
    b.pbd.spring_slots =
        b.add_buffer(kJacobi, "corrections of springs", std::max<std::size_t>(of.springs.size(), 1) * vector);
    if (!of.hinges.empty())
        b.pbd.hinge_slots = b.add_buffer(kJacobi, "corrections of hinges", 4 * of.hinges.size() * vector);
    if (!of.volumes.empty())
        b.pbd.volume_slots =
            b.add_buffer(kJacobi, "corrections of tetrahedra", 4 * of.volumes.size() * vector);
}

void record_pbd_jacobi(PlanBuilder& b, const Moment& moment)
{
    if (b.pbd.other == kNoBuffer)
        return;
    const MethodSettings& m = b.scene.method;
    const PbdBuffers& p = b.pbd;
    const bool hinges = p.hinges != kNoBuffer, volumes = p.volumes != kNoBuffer;
    const double weight = chebyshev_weight(m.spectral_radius, moment.iteration);
    const std::string variant = jacobi_variant(p, weight != 1);
    const auto relaxation = static_cast<float>(m.relaxation), omega = static_cast<float>(weight);
    const std::uint32_t n = b.plan.vertex_count, report = moment.last;
    const std::uint32_t listed = 8 + (hinges ? 16 : 0) + (volumes ? 16 : 0);
    const Shares shares = shares_of(b);
    if (m.scheme == ElementScheme::constraint_centric)
    {
        record_slots(b, shares, report);
        const kernels::pbd_average::Bindings<Use> uses = {.position = {b.plan.position},
                                                          .delta = {b.plan.delta},
                                                          .next = {p.other},
                                                          .spring_correction = {p.spring_slots, 8},
                                                          .at = {p.at, listed},
                                                          .hinge_correction = {p.hinge_slots, 16},
                                                          .volume_correction = {p.volume_slots, 16}};
        b.dispatch(kJacobi, variant, uses, {n, relaxation, omega, p.hinges_at, p.volumes_at}, n);
    }
    else
    {
        const kernels::pbd_node::Bindings<Use> uses = {.position = {b.plan.position},
                                                       .delta = {b.plan.delta},
                                                       .next = {p.other},
                                                       .events = {b.plan.events, 0},
                                                       .spring = {p.springs, 8},
                                                       .at = {p.at, listed},
                                                       .hinge = {p.hinges, 16},
                                                       .tetrahedron = {p.volumes, 16}};
        b.dispatch(kJacobi, variant, uses,
                   {n, shares.stretch, shares.bend, shares.volume, relaxation, omega, report, p.hinges_at,
                    p.volumes_at},
                   n);
    }
    std::swap(b.plan.delta, b.pbd.other);
}

} // namespace taut
