// Based on: Sims. Parallel Cloth Simulation Using OpenMP and CUDA. Louisiana State University 2009 (CPU and
// GPU
//   share one simulation); Graham. Bounds on Multiprocessing Timing Anomalies. SIAM J. Appl. Math. 17(2),
//   1969.
// Departures: whole bodies are divided, not loops, so nothing is exchanged during a step and the result does
//   not depend on the division.

#include "taut/world/hybrid.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/methods.hpp"
#include "taut/runtime/required.hpp"
#include "taut/world/carry.hpp"
#include "taut/world/moved.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <utility>

namespace taut {
namespace {

using Clockwork = std::chrono::steady_clock;

constexpr double kWorthMoving = 0.9; ///< share of the present time that a new division must promise
constexpr int kTimedSteps = 3;

double milliseconds_since(Clockwork::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clockwork::now() - start).count();
}

std::uint64_t work_of(const Body& body)
{
    std::uint64_t work = body.mesh.positions.size() + stretch_elements(body).size() +
                         2 * bend_elements(body).size() + 2 * body.mesh.tetrahedra.size();
    for (const Body::Elements& list : body.elements)
        work += list.vertices.size();
    return work;
}

Events less(Events all, const Events& part)
{
    all.non_finite -= part.non_finite;
    all.speed_clamped -= part.speed_clamped;
    all.degenerate -= part.degenerate;
    all.conflicts -= part.conflicts;
    return all;
}

/// The longest solve stays: the steps that are taken back are those that come next.
SolverReport less(SolverReport all, const SolverReport& part)
{
    all.solves -= part.solves;
    all.iterations -= part.iterations;
    all.limited -= part.limited;
    all.failed -= part.failed;
    return all;
}

/// One part: a device and the world of its bodies, if it has any.
struct DevicePart
{
    std::shared_ptr<Device> device;
    std::vector<std::uint32_t> bodies;
    std::unique_ptr<World> world;
    double milliseconds = 0;
    Events timed_events; ///< what the timed steps of `world` counted, which were taken back
    SolverReport timed_solves;

    Events events() const { return world ? less(world->events(), timed_events) : Events{}; }
    SolverReport solver_report() const
    {
        return world ? less(world->solver_report(), timed_solves) : SolverReport{};
    }
};

} // namespace

std::vector<bool> divide(const std::vector<std::uint64_t>& work, double first_speed, double second_speed)
{
    std::vector<std::size_t> order(work.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return work[a] > work[b]; });
    std::vector<bool> first(work.size());
    double until_first = 0, until_second = 0;
    for (const std::size_t body : order)
    {
        const double amount = static_cast<double>(work[body]);
        const double then_first = until_first + amount / first_speed;
        const double then_second = until_second + amount / second_speed;
        first[body] = then_first <= then_second;
        (first[body] ? until_first : until_second) = first[body] ? then_first : then_second;
    }
    return first;
}

struct HybridWorld::Impl
{
    Scene scene;
    HybridOptions options;
    std::array<DevicePart, 2> parts;
    std::vector<std::uint64_t> work;  ///< of each body
    std::vector<std::uint32_t> first; ///< scene-wide vertex of each body, and the total
    std::uint64_t steps = 0, divisions = 0;
    Events before; ///< of worlds that a division ended
    SolverReport solved_before; ///< the same of their solves
    Moved program;

    std::vector<std::uint32_t> vertices(const DevicePart& part) const
    {
        return scene_vertices(part.world->plan(), part.bodies, first);
    }
    const World& any() const { return parts[0].world ? *parts[0].world : *parts[1].world; }

    void assign(const std::vector<bool>& to_first);
    void time_both();
    double speed(const DevicePart& part) const;
    double predicted(const std::vector<bool>& to_first) const;
    void rebalance();
    CarriedState carried() const;
    std::pair<World*, std::size_t> world_of(std::size_t body, const char* who);
};

/// Makes the worlds of a division.
void HybridWorld::Impl::assign(const std::vector<bool>& to_first)
{
    for (std::size_t s = 0; s < parts.size(); ++s)
    {
        DevicePart& part = parts[s];
        part.bodies.clear();
        part.world.reset();
        part.milliseconds = 0;
        part.timed_events = {};
        part.timed_solves = {};
        for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
            if (to_first[b] == (s == 0))
                part.bodies.push_back(b);
        if (!part.bodies.empty())
            part.world = std::make_unique<World>(with_bodies(scene, part.bodies), part.device, options.world);
    }
}

/// A step of each part alone, the least of some; the worlds are then where they were.
void HybridWorld::Impl::time_both()
{
    for (DevicePart& part : parts)
    {
        if (!part.world)
            continue;
        const WorldState state = part.world->state();
        const Events events = part.events();
        const SolverReport solved = part.solver_report();
        for (int turn = 0; turn <= kTimedSteps; ++turn)
        {
            const auto start = Clockwork::now();
            part.world->step();
            part.device->wait();
            const double took = milliseconds_since(start);
            if (turn > 0) // the first warms up
                part.milliseconds = turn == 1 ? took : std::min(part.milliseconds, took);
        }
        part.world->restore(state);
        part.timed_events = less(part.world->events(), events);
        part.timed_solves = less(part.world->solver_report(), solved);
    }
}

/// Work a millisecond; a part without bodies keeps the other's guess, so that it gets some when that pays.
double HybridWorld::Impl::speed(const DevicePart& part) const
{
    std::uint64_t amount = 0;
    for (const std::uint32_t b : part.bodies)
        amount += work[b];
    return part.milliseconds > 0 ? static_cast<double>(amount) / part.milliseconds : 0;
}

double HybridWorld::Impl::predicted(const std::vector<bool>& to_first) const
{
    double until[2] = {0, 0};
    for (std::size_t b = 0; b < work.size(); ++b)
        until[to_first[b] ? 0 : 1] += static_cast<double>(work[b]) / speed(parts[to_first[b] ? 0 : 1]);
    return std::max(until[0], until[1]);
}

CarriedState HybridWorld::Impl::carried() const
{
    CarriedState out;
    for (const DevicePart& part : parts)
        if (part.world)
            collect(*part.world, vertices(part), first.back(), out);
    out.moved = program.values();
    return out;
}

/// Divides anew by the measured speeds where that pays.
void HybridWorld::Impl::rebalance()
{
    if (!parts[0].world || !parts[1].world)
        return; // nothing is known of the idle device's speed any more
    const std::vector<bool> now = divide(work, speed(parts[0]), speed(parts[1]));
    std::vector<bool> old(work.size(), false);
    for (const std::uint32_t b : parts[0].bodies)
        old[b] = true;
    if (now == old || predicted(now) > kWorthMoving * predicted(old))
        return;
    for (const DevicePart& part : parts)
    {
        add(before, part.events());
        add(solved_before, part.solver_report());
    }
    const CarriedState state = carried();
    assign(now);
    for (DevicePart& part : parts)
        if (part.world)
            deliver(*part.world, vertices(part), part.bodies, state);
    divisions += steps > 0;
}

HybridWorld::HybridWorld(const Scene& scene, std::shared_ptr<Device> one, std::shared_ptr<Device> other,
                         const HybridOptions& options)
    : impl_(std::make_unique<Impl>())
{
    Impl& my = *impl_;
    one = required(std::move(one), "a HybridWorld");
    other = required(std::move(other), "a HybridWorld");
    const bool meshes = std::all_of(scene.bodies.begin(), scene.bodies.end(),
                                    [](const Body& b) { return !b.mesh.positions.empty(); });
    my.scene = meshes ? scene : resolve(scene);
    if (my.scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "a hybrid world has nothing to divide: the scene has no bodies");
    // Those that meet themselves alone, too: any of them calls for a search of all on its device, so results
    // would depend on the division, which follows from time.
    if (wants_contact(my.scene))
        throw Error(ErrorCode::unsupported, "a hybrid world cannot divide bodies that meet each other or "
                                            "themselves; use one device, or leave contact out");
    for (const Body& body : my.scene.bodies)
        if (body.material.tear_strain > 0)
            throw Error(ErrorCode::unsupported,
                        "a hybrid world cannot tear cloth, whose number of vertices changes; use one "
                        "device, or leave tear_strain out");
    // The stiffest body, or the only solid, may be on one part; both parts take what it asks for.
    my.scene.method.line_search = line_search_of(my.scene);
    if (const auto substeps = find_method(my.scene.method.type).substeps)
        my.scene.method.substeps = substeps(my.scene).count;
    my.options = options;
    my.parts[0].device = std::move(one);
    my.parts[1].device = std::move(other);
    my.first.push_back(0);
    for (const Body& body : my.scene.bodies)
    {
        my.work.push_back(work_of(body));
        my.first.push_back(my.first.back() + static_cast<std::uint32_t>(body.mesh.positions.size()));
    }
    my.program.start(my.scene);
    moved_ = &my.program;
    // Halves by work first: both devices then show what they can.
    my.assign(divide(my.work, 1, 1));
    my.time_both();
    my.rebalance();
    my.before = {};
    my.solved_before = {};
}

HybridWorld::~HybridWorld() = default;
HybridWorld::HybridWorld(HybridWorld&&) noexcept = default;
HybridWorld& HybridWorld::operator=(HybridWorld&&) noexcept = default;

void HybridWorld::step()
{
    Impl& my = *impl_;
    const bool due = my.options.measure_every > 0 && my.steps > 0 && my.steps % my.options.measure_every == 0;
    const bool movable = std::all_of(my.parts.begin(), my.parts.end(), [](const DevicePart& s) {
        return !s.world || s.world->plan().kept.empty();
    });
    if (due && movable)
    {
        my.time_both();
        my.rebalance();
    }
    my.program.begin_step(my.scene, time(), time() + my.scene.timestep);
    for (const DevicePart& part : my.parts)
        if (part.world && !my.program.idle())
            Moved::of(*part.world).obey(part_of(my.program.values(), part.bodies));
    // The native CPU computes where it is asked, so the other device goes first.
    for (const std::size_t s : {1, 0})
        if (my.parts[s].world)
            my.parts[s].world->step();
    my.program.end_step(my.scene.timestep);
    for (const DevicePart& part : my.parts)
        if (part.world)
            part.device->wait();
    ++my.steps;
}

std::uint64_t HybridWorld::steps() const { return impl_->steps; }
double HybridWorld::time() const { return impl_->any().time(); }
const Scene& HybridWorld::scene() const { return impl_->scene; }

std::vector<glm::dvec3> HybridWorld::positions() const
{
    std::vector<glm::dvec3> out(impl_->first.back());
    for (const DevicePart& part : impl_->parts)
        if (part.world)
            place(out, part.world->positions(), part.world->plan(), part.bodies, impl_->first);
    return out;
}

std::vector<glm::dvec3> HybridWorld::velocities() const
{
    std::vector<glm::dvec3> out(impl_->first.back());
    for (const DevicePart& part : impl_->parts)
        if (part.world)
            place(out, part.world->velocities(), part.world->plan(), part.bodies, impl_->first);
    return out;
}

Events HybridWorld::events() const
{
    Events sum = impl_->before;
    for (const DevicePart& part : impl_->parts)
        add(sum, part.events());
    return sum;
}

SolverReport HybridWorld::solver_report() const
{
    SolverReport sum = impl_->solved_before;
    for (const DevicePart& part : impl_->parts)
        if (part.world)
            add(sum, part.solver_report());
    return sum;
}

/// The part of a body, and its number there.
std::pair<World*, std::size_t> HybridWorld::Impl::world_of(std::size_t body, const char* who)
{
    for (DevicePart& part : parts)
        for (std::size_t own = 0; own < part.bodies.size(); ++own)
            if (part.bodies[own] == body)
                return {part.world.get(), own};
    throw Error(ErrorCode::bad_input, std::string(who) + ": body " + std::to_string(body) + " of " +
                                          std::to_string(scene.bodies.size()) + ", numbered from 0");
}

void HybridWorld::set_positions(std::size_t body, std::span<const glm::dvec3> positions)
{
    const auto [world, own] = impl_->world_of(body, "set_positions");
    world->set_positions(own, positions);
}

void HybridWorld::set_velocities(std::size_t body, std::span<const glm::dvec3> velocities)
{
    const auto [world, own] = impl_->world_of(body, "set_velocities");
    world->set_velocities(own, velocities);
}

std::vector<HybridPart> HybridWorld::parts() const
{
    std::vector<HybridPart> out;
    for (const DevicePart& part : impl_->parts)
    {
        HybridPart told{part.device->info(), part.bodies, 0, 0, part.milliseconds};
        for (const std::uint32_t b : part.bodies)
        {
            told.vertices += impl_->first[b + 1] - impl_->first[b];
            told.work += impl_->work[b];
        }
        out.push_back(std::move(told));
    }
    return out;
}

std::uint64_t HybridWorld::divisions() const { return impl_->divisions; }

void HybridWorld::copy_into(World& whole) const
{
    if (!whole.plan().kept.empty())
        throw Error(ErrorCode::unsupported, "method " + quoted(impl_->scene.method.type) +
                                                " keeps more than places and speeds, which a hybrid world "
                                                "does not put together");
    std::vector<std::uint32_t> all(impl_->scene.bodies.size());
    std::iota(all.begin(), all.end(), 0u);
    deliver(whole, scene_vertices(whole.plan(), all, impl_->first), all, impl_->carried());
}

} // namespace taut
