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

/// One side: a device and the world of its bodies, if it has any.
struct Side
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
    std::array<Side, 2> sides;
    std::vector<std::uint64_t> work;  ///< of each body
    std::vector<std::uint32_t> first; ///< scene-wide vertex of each body, and the total
    std::uint64_t steps = 0, divisions = 0;
    Events before; ///< of worlds that a division ended
    SolverReport solved_before; ///< the same of their solves
    Moved program;

    std::vector<std::uint32_t> vertices(const Side& side) const
    {
        return scene_vertices(side.world->plan(), side.bodies, first);
    }
    const World& any() const { return sides[0].world ? *sides[0].world : *sides[1].world; }

    void assign(const std::vector<bool>& to_first);
    void time_both();
    double speed(const Side& side) const;
    double predicted(const std::vector<bool>& to_first) const;
    void rebalance();
    Carried carried() const;
    std::pair<World*, std::size_t> world_of(std::size_t body, const char* who);
};

/// Makes the worlds of a division.
void HybridWorld::Impl::assign(const std::vector<bool>& to_first)
{
    for (std::size_t s = 0; s < sides.size(); ++s)
    {
        Side& side = sides[s];
        side.bodies.clear();
        side.world.reset();
        side.milliseconds = 0;
        side.timed_events = {};
        side.timed_solves = {};
        for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
            if (to_first[b] == (s == 0))
                side.bodies.push_back(b);
        if (!side.bodies.empty())
            side.world = std::make_unique<World>(with_bodies(scene, side.bodies), side.device, options.world);
    }
}

/// A step of each side alone, the least of some; the worlds are then where they were.
void HybridWorld::Impl::time_both()
{
    for (Side& side : sides)
    {
        if (!side.world)
            continue;
        const WorldState state = side.world->state();
        const Events events = side.events();
        const SolverReport solved = side.solver_report();
        for (int turn = 0; turn <= kTimedSteps; ++turn)
        {
            const auto start = Clockwork::now();
            side.world->step();
            side.device->wait();
            const double took = milliseconds_since(start);
            if (turn > 0) // the first warms up
                side.milliseconds = turn == 1 ? took : std::min(side.milliseconds, took);
        }
        side.world->restore(state);
        side.timed_events = less(side.world->events(), events);
        side.timed_solves = less(side.world->solver_report(), solved);
    }
}

/// Work a millisecond; a side without bodies keeps the other's guess, so that it gets some when that pays.
double HybridWorld::Impl::speed(const Side& side) const
{
    std::uint64_t amount = 0;
    for (const std::uint32_t b : side.bodies)
        amount += work[b];
    return side.milliseconds > 0 ? static_cast<double>(amount) / side.milliseconds : 0;
}

double HybridWorld::Impl::predicted(const std::vector<bool>& to_first) const
{
    double until[2] = {0, 0};
    for (std::size_t b = 0; b < work.size(); ++b)
        until[to_first[b] ? 0 : 1] += static_cast<double>(work[b]) / speed(sides[to_first[b] ? 0 : 1]);
    return std::max(until[0], until[1]);
}

Carried HybridWorld::Impl::carried() const
{
    Carried out;
    for (const Side& side : sides)
        if (side.world)
            collect(*side.world, vertices(side), first.back(), out);
    out.moved = program.values();
    return out;
}

/// Divides anew by the measured speeds where that pays.
void HybridWorld::Impl::rebalance()
{
    if (!sides[0].world || !sides[1].world)
        return; // nothing is known of the idle device's speed any more
    const std::vector<bool> now = divide(work, speed(sides[0]), speed(sides[1]));
    std::vector<bool> old(work.size(), false);
    for (const std::uint32_t b : sides[0].bodies)
        old[b] = true;
    if (now == old || predicted(now) > kWorthMoving * predicted(old))
        return;
    for (const Side& side : sides)
    {
        add(before, side.events());
        add(solved_before, side.solver_report());
    }
    const Carried state = carried();
    assign(now);
    for (Side& side : sides)
        if (side.world)
            deliver(*side.world, vertices(side), side.bodies, state);
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
    if (wants_contact(my.scene))
        throw Error(ErrorCode::unsupported, "a hybrid world cannot divide bodies that meet each other or "
                                            "themselves; use one device, or leave contact out");
    for (const Body& body : my.scene.bodies)
        if (body.material.tear_strain > 0)
            throw Error(ErrorCode::unsupported,
                        "a hybrid world cannot tear cloth, whose number of vertices changes; use one "
                        "device, or leave tear_strain out");
    // The stiffest body, or the only solid, may be on one side; both sides take what it asks for.
    my.scene.method.line_search = line_search_of(my.scene);
    if (const auto substeps = find_method(my.scene.method.type).substeps)
        my.scene.method.substeps = substeps(my.scene).count;
    my.options = options;
    my.sides[0].device = std::move(one);
    my.sides[1].device = std::move(other);
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
    const bool movable = std::all_of(my.sides.begin(), my.sides.end(),
                                     [](const Side& s) { return !s.world || s.world->plan().kept.empty(); });
    if (due && movable)
    {
        my.time_both();
        my.rebalance();
    }
    my.program.begin_step(my.scene, time(), time() + my.scene.timestep);
    for (const Side& side : my.sides)
        if (side.world && !my.program.idle())
            Moved::of(*side.world).obey(part_of(my.program.values(), side.bodies));
    // The native CPU computes where it is asked, so the other device goes first.
    for (const std::size_t s : {1, 0})
        if (my.sides[s].world)
            my.sides[s].world->step();
    my.program.end_step(my.scene.timestep);
    for (const Side& side : my.sides)
        if (side.world)
            side.device->wait();
    ++my.steps;
}

std::uint64_t HybridWorld::steps() const { return impl_->steps; }
double HybridWorld::time() const { return impl_->any().time(); }
const Scene& HybridWorld::scene() const { return impl_->scene; }

std::vector<glm::dvec3> HybridWorld::positions() const
{
    std::vector<glm::dvec3> out(impl_->first.back());
    for (const Side& side : impl_->sides)
        if (side.world)
            place(out, side.world->positions(), side.world->plan(), side.bodies, impl_->first);
    return out;
}

std::vector<glm::dvec3> HybridWorld::velocities() const
{
    std::vector<glm::dvec3> out(impl_->first.back());
    for (const Side& side : impl_->sides)
        if (side.world)
            place(out, side.world->velocities(), side.world->plan(), side.bodies, impl_->first);
    return out;
}

Events HybridWorld::events() const
{
    Events sum = impl_->before;
    for (const Side& side : impl_->sides)
        add(sum, side.events());
    return sum;
}

SolverReport HybridWorld::solver_report() const
{
    SolverReport sum = impl_->solved_before;
    for (const Side& side : impl_->sides)
        if (side.world)
            add(sum, side.solver_report());
    return sum;
}

/// The side of a body, and its number there.
std::pair<World*, std::size_t> HybridWorld::Impl::world_of(std::size_t body, const char* who)
{
    for (Side& side : sides)
        for (std::size_t own = 0; own < side.bodies.size(); ++own)
            if (side.bodies[own] == body)
                return {side.world.get(), own};
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
    for (const Side& side : impl_->sides)
    {
        HybridPart part{side.device->info(), side.bodies, 0, 0, side.milliseconds};
        for (const std::uint32_t b : side.bodies)
        {
            part.vertices += impl_->first[b + 1] - impl_->first[b];
            part.work += impl_->work[b];
        }
        out.push_back(std::move(part));
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
