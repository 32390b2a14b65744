// The state of a world as values: out of it, into it, and from one scene into the next after a tear.

#include "taut/linear/cg_state.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/world/held_pairs.hpp"
#include "taut/world/world_impl.hpp"

#include <glm/geometric.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace taut {

namespace {

/// What a vertex had, for each part of it; `before` and `from` are in the plans' orders.
std::vector<std::byte> spread(const std::vector<std::byte>& before, const std::vector<std::uint32_t>& from,
                              std::size_t element)
{
    std::vector<std::byte> out(from.size() * element);
    for (std::size_t v = 0; v < from.size(); ++v)
        std::memcpy(out.data() + v * element, before.data() + from[v] * element, element);
    return out;
}

/// Plan vertex in `before` of each plan vertex in `now`.
std::vector<std::uint32_t> places(const Plan& before, const Plan& now,
                                  const std::vector<std::uint32_t>& origin)
{
    std::vector<std::uint32_t> place_of(before.vertex_count), out;
    for (std::uint32_t v = 0; v < before.vertex_count; ++v)
        place_of[before.original[v]] = v;
    for (const std::uint32_t v : now.original)
        out.push_back(place_of[origin[v]]);
    return out;
}

} // namespace

/// Plans the scene anew (after a tear, or for longer lists of contact) and carries the state over, bit for
/// bit; inverse masses are the new plan's.
void World::Impl::replace_scene(const TornScene& next)
{
    const std::vector<std::byte> position = raw(plan.position), low = raw(plan.low),
                                 velocity = raw(plan.velocity), delta = raw(plan.delta), force = forces,
                                 coasting = raw(plan.coasting), owed = raw(plan.owed),
                                 events = raw(plan.events);
    const ContactLists contacts = contact_lists();
    std::vector<std::vector<std::byte>> carried; // what stays as long as the mesh does
    for (const std::uint32_t buffer : plan.kept)
        carried.push_back(next.splits == 0 ? raw(buffer) : std::vector<std::byte>());
    std::vector<std::vector<std::byte>> logs; // of linear solves: they count over the whole run
    for (const PlanSolver& solver : plan.solvers)
        logs.push_back(raw(solver.log));
    const Plan before = std::exchange(plan, make_plan(next.scene, traits, options));
    program.tear(scene, next.scene, next.origin);
    scene = next.scene;
    torn += next.splits;
    overlong = 0;
    recording.reset();
    buffers.clear();
    create_buffers();
    record();
    const std::vector<std::uint32_t> from = places(before, plan, next.origin);
    const std::size_t element = 4 * real_bytes(plan.precision), mass = 3 * real_bytes(plan.precision);
    std::vector<std::byte> moved = spread(position, from, element);
    const std::vector<std::byte>& fresh = plan.buffers[plan.position].initial;
    for (std::size_t v = 0; v < from.size(); ++v)
        std::memcpy(moved.data() + v * element + mass, fresh.data() + v * element + mass, element - mass);
    device->write(buffers[plan.position], 0, moved);
    device->write(buffers[plan.low], 0, spread(low, from, element));
    device->write(buffers[plan.velocity], 0, spread(velocity, from, element));
    device->write(buffers[plan.delta], 0, spread(delta, from, element));
    if (plan.coasting != kNoBuffer)
        device->write(buffers[plan.coasting], 0, spread(coasting, from, element));
    if (plan.owed != kNoBuffer && !owed.empty())
        device->write(buffers[plan.owed], 0, spread(owed, from, element));
    device->write(buffers[plan.events], 0, events);
    for (std::size_t k = 0; k < std::min(logs.size(), plan.solvers.size()); ++k)
        device->write(buffers[plan.solvers[k].log], 0, logs[k]);
    for (std::size_t k = 0; next.splits == 0 && k < plan.kept.size(); ++k)
        device->write(buffers[plan.kept[k]], 0, carried[k]);
    carry_contacts(contacts, from, next.splits == 0);
    if (plan.force != kNoBuffer)
    {
        keep_forces(spread(force, from, element));
        device->write(buffers[plan.force], 0, forces);
    }
    stale = true;
}

WorldState World::state() const
{
    impl_->hand_over_places();
    const Plan& plan = impl_->plan;
    WorldState out{impl_->steps,
                   impl_->raw(plan.position),
                   impl_->raw(plan.low),
                   impl_->raw(plan.velocity),
                   impl_->raw(plan.delta),
                   impl_->forces,
                   impl_->clock};
    for (const std::uint32_t buffer : plan.kept)
        out.kept.push_back(impl_->raw(buffer));
    out.coasting = impl_->raw(plan.coasting);
    out.owed = impl_->raw(plan.owed);
    out.held = impl_->held_pairs();
    out.moved = impl_->program.values();
    out.contact_capacity = plan.contact.capacity;
    out.push = impl_->push;
    out.kick = impl_->kick;
    out.placed = impl_->placings;
    out.given_up = impl_->given_up;
    return out;
}

namespace {

template <typename Real>
bool all_finite(std::span<const std::byte> bytes)
{
    for (std::size_t i = 0; i + sizeof(Real) <= bytes.size(); i += sizeof(Real))
    {
        Real value;
        std::memcpy(&value, bytes.data() + i, sizeof(Real));
        if (!std::isfinite(value))
            return false;
    }
    return true;
}

} // namespace

void World::restore(const WorldState& state)
{
    const Plan& plan = impl_->plan;
    const std::pair<std::uint32_t, const std::vector<std::byte>*> parts[] = {
        {plan.position, &state.position}, {plan.low, &state.low},     {plan.velocity, &state.velocity},
        {plan.delta, &state.delta},       {plan.force, &state.force},
    };
    const char* names[] = {"position", "low", "velocity", "delta", "force"};
    for (std::size_t i = 0; i < std::size(parts); ++i)
    {
        const std::uint64_t expected = parts[i].first == kNoBuffer ? 0 : plan.buffers[parts[i].first].bytes;
        if (parts[i].second->size() != expected)
            throw Error(ErrorCode::bad_input, std::string("restore: ") + names[i] + " holds " +
                                                  std::to_string(parts[i].second->size()) +
                                                  " bytes, this plan needs " + std::to_string(expected) +
                                                  ": the state is of another scene or precision");
        const bool finite = plan.precision == Precision::float64 ? all_finite<double>(*parts[i].second)
                                                                 : all_finite<float>(*parts[i].second);
        if (!finite)
            throw Error(ErrorCode::bad_input,
                        std::string("restore: ") + names[i] + " holds a value that is not finite");
    }
    bool same = state.kept.size() == plan.kept.size();
    for (std::size_t i = 0; same && i < plan.kept.size(); ++i)
        same = state.kept[i].size() == plan.buffers[plan.kept[i]].bytes;
    if (!same)
        throw Error(ErrorCode::bad_input, "restore: what method " + quoted(impl_->scene.method.type) +
                                              " keeps from step to step is missing or of another size: the "
                                              "state is of another scene or method");
    const Clock& clock = state.clock;
    const double sum = clock.time + clock.timestep + glm::length(clock.gravity) + glm::length(clock.fall);
    if (!std::isfinite(sum) || clock.timestep < 0 || clock.step > state.step)
        throw Error(ErrorCode::bad_input, "restore: the clock is not that of step " +
                                              std::to_string(state.step) +
                                              ": it must be finite and begin at that step or before");
    impl_->program.check(impl_->scene, state.moved);
    if (state.contact_capacity > kMostContactPairs)
        throw Error(ErrorCode::bad_input, "restore: contact_capacity is " +
                                              std::to_string(state.contact_capacity) +
                                              "; it must be at most " + std::to_string(kMostContactPairs));
    check_held(state.held, plan.vertex_count);
    // Pairs that a shorter list would miss are part of how it goes on.
    if (plan.contact.control != kNoBuffer && state.contact_capacity > plan.contact.capacity)
        impl_->hold_contacts(state.contact_capacity);
    impl_->program.assign(impl_->scene, state.moved);
    impl_->placed = {};
    for (const auto& [buffer, bytes] : parts)
        if (buffer != kNoBuffer)
            impl_->device->write(impl_->buffers[buffer], 0, *bytes);
    if (plan.force != kNoBuffer)
        impl_->keep_forces(state.force);
    for (std::size_t i = 0; i < plan.kept.size(); ++i)
        impl_->device->write(impl_->buffers[plan.kept[i]], 0, state.kept[i]);
    // A world without this buffer says that gravity alone acted.
    const bool told = state.coasting.size() == state.delta.size();
    if (plan.coasting != kNoBuffer)
        impl_->device->write(impl_->buffers[plan.coasting], 0, told ? state.coasting : state.delta);
    if (plan.owed != kNoBuffer)
        impl_->device->write(impl_->buffers[plan.owed], 0,
                             state.owed.size() == state.delta.size()
                                 ? state.owed
                                 : std::vector<std::byte>(plan.buffers[plan.owed].bytes));
    if (plan.contact.place != kNoBuffer)
    {
        impl_->put_held_pairs(state.held);
        const InputWrite forgotten = impl_->lists_forgotten();
        impl_->device->write(impl_->buffers[forgotten.buffer], 0, forgotten.bytes);
    }
    impl_->steps = state.step;
    impl_->guessed = false;
    impl_->push = state.push;
    impl_->kick = state.kick;
    impl_->placings = state.placed;
    impl_->given_up = state.given_up;
    const bool clocked = state.clock.timestep > 0;
    impl_->clock = clocked ? state.clock : Clock{0, 0, impl_->scene.timestep, impl_->scene.gravity};
    const Pace before = impl_->pace(impl_->clock);
    impl_->move_velocities(before);
    if (impl_->clock.timestep != impl_->scene.timestep || before != impl_->pace())
        impl_->restart_clock(impl_->clock);
    impl_->stale = true;
}

SolverReport World::solver_report() const
{
    SolverReport out;
    for (const PlanSolver& solver : impl_->plan.solvers)
    {
        const auto log = impl_->device->read<layout::SolveLog<float>>(impl_->buffers[solver.log], 1).front();
        out.solves += log.solves;
        out.iterations += log.iterations;
        out.most = std::max<std::uint64_t>(out.most, log.most);
        out.limited += log.limited;
        out.failed += log.failed;
        layout::CgState<float> ended{};
        ended.status = log.last_status;
        if (impl_->steps > 0)
            out.last = linear::outcome_of(ended).status;
    }
    return out;
}

} // namespace taut
