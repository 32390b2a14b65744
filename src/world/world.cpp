#include "taut/world/world_impl.hpp"

#include "taut/plan/constraints.hpp"
#include "taut/runtime/required.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"
#include "taut/world/inputs.hpp"
#include "taut/world/planned.hpp"
#include "taut/world/separate_start.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut {

void World::Impl::create_buffers() { buffers = make_buffers(*device, plan); }

void World::Impl::record()
{
    if (!plan.passes.empty())
        recording = device->compile({buffers, plan.passes, plan.barrier_before});
}

/// A stretch of time with the scene's timestep and gravity, after one that may have had others.
void World::Impl::restart_clock(const Clock& before)
{
    const double time = before.at(steps);
    const Pace now = pace();
    const double past = time - before.time;
    clock = {steps,
             time,
             scene.timestep,
             scene.gravity,
             before.fall + before.gravity * past,
             before.fall_length + glm::length(before.gravity) * past,
             before.steady && (steps == 0 || before.gravity == scene.gravity),
             now.substep,
             now.lead};
}

Pace World::Impl::pace() const { return {scene.timestep / plan.substeps, scene.gravity, plan.velocity_lead}; }

/// That of a state; one without a clock is as the world's own.
Pace World::Impl::pace(const Clock& of) const
{
    if (!(of.substep > 0))
        return {of.timestep / plan.substeps, of.gravity, plan.velocity_lead};
    return {of.substep, of.gravity, of.lead};
}

/// Inputs that do not move are written before the first step and after something has changed them, only.
std::vector<InputWrite> World::Impl::take_inputs()
{
    std::vector<InputWrite> inputs;
    parts = 1;
    const Stretch step{clock.at(steps), clock.at(steps + 1)};
    const bool ordered = program.begin_step(scene, step.from, step.to);
    if (moves || stale || ordered)
        inputs = step_inputs(scene, plan, step, program.values());
    stale = false;
    if (forces_changed)
    {
        weigh_forces();
        inputs.push_back({plan.force, forces});
    }
    forces_changed = false;
    for (InputWrite& places : take_places())
        inputs.push_back(std::move(places));
    return inputs;
}

template <typename Real>
std::vector<glm::dvec3> World::Impl::read_vectors(std::uint32_t buffer, std::uint32_t added,
                                                  const Vertices& of) const
{
    using Vec = glm::vec<4, Real>;
    const std::uint64_t offset = of.first * sizeof(Vec);
    std::vector<glm::dvec3> out(of.count);
    const auto values = device->read<Vec>(buffers[buffer], of.count, offset);
    for (std::uint32_t v = 0; v < of.count; ++v)
        out[plan.original[of.first + v] - of.first] = glm::dvec3(values[v]);
    if (added == kNoBuffer)
        return out;
    const auto more = device->read<Vec>(buffers[added], of.count, offset);
    for (std::uint32_t v = 0; v < of.count; ++v)
        out[plan.original[of.first + v] - of.first] += glm::dvec3(more[v]);
    return out;
}

std::vector<glm::dvec3> World::Impl::vectors(std::uint32_t buffer, std::uint32_t added,
                                             const Vertices& of) const
{
    if (buffer == kNoBuffer)
        return {};
    return plan.precision == Precision::float64 ? read_vectors<double>(buffer, added, of)
                                                : read_vectors<float>(buffer, added, of);
}

std::vector<double> World::Impl::of_constraints(std::string_view kind,
                                                std::uint32_t ConstraintSet::*buffer) const
{
    const ConstraintSet* set = find_set(plan, kind);
    if (!set || set->*buffer == kNoBuffer)
        return {};
    if (plan.precision == Precision::float64)
        return device->read<double>(buffers[set->*buffer], set->count);
    const auto values = device->read<float>(buffers[set->*buffer], set->count);
    return {values.begin(), values.end()};
}

template <typename Real>
World::Impl::KeptBuffers<Real> World::Impl::read_kept(const Vertices& of) const
{
    using Vec = glm::vec<4, Real>;
    const auto read = [&](std::uint32_t buffer) {
        return device->read<Vec>(buffers[buffer], of.count, of.first * sizeof(Vec));
    };
    KeptBuffers<Real> out{read(plan.velocity), read(plan.delta), {}};
    out.coasting = plan.coasting != kNoBuffer ? read(plan.coasting) : out.displacement;
    return out;
}

template <typename Real>
std::vector<Kept> World::Impl::kept(const Vertices& of) const
{
    const KeptBuffers<Real> read = read_kept<Real>(of);
    std::vector<Kept> out;
    for (std::uint32_t v = 0; v < of.count; ++v)
        out.push_back({plan.pull[of.first + v], glm::dvec3(read.velocity[v]),
                       glm::dvec3(read.displacement[v]), glm::dvec3(read.coasting[v])});
    return out;
}
template std::vector<Kept> World::Impl::kept<float>(const Vertices&) const;
template std::vector<Kept> World::Impl::kept<double>(const Vertices&) const;

template <typename Real>
std::vector<glm::dvec3> World::Impl::velocities_of(const Vertices& of) const
{
    const KeptBuffers<Real> read = read_kept<Real>(of);
    const auto its = [&](const auto& list) { return std::span(list).subspan(of.first, of.count); };
    return velocities_at_step<Real>(pace(), its(plan.pull), its(plan.original), of.first, read.velocity,
                                    read.displacement, read.coasting);
}

std::vector<glm::dvec3> World::Impl::velocities(const Vertices& of) const
{
    if (plan.velocity == kNoBuffer)
        return {};
    return plan.precision == Precision::float64 ? velocities_of<double>(of) : velocities_of<float>(of);
}

template <typename Real>
void World::Impl::repace(const Pace& before)
{
    std::vector<glm::vec<4, Real>> velocity, coasting;
    for (const Kept& vertex : kept<Real>(all()))
    {
        const Kept moved = repaced(before, pace(), vertex);
        velocity.emplace_back(glm::vec<3, Real>(moved.velocity), Real(0));
        coasting.emplace_back(glm::vec<3, Real>(moved.coasting), Real(0));
    }
    device->write<glm::vec<4, Real>>(buffers[plan.velocity], velocity);
    if (plan.coasting != kNoBuffer)
        device->write<glm::vec<4, Real>>(buffers[plan.coasting], coasting);
}

/// Keeps the velocities at the step where those between the steps stood otherwise.
void World::Impl::move_velocities(const Pace& before)
{
    if (before == pace() || plan.velocity == kNoBuffer)
        return;
    if (plan.precision == Precision::float64)
        repace<double>(before);
    else
        repace<float>(before);
}

std::vector<std::byte> World::Impl::raw(std::uint32_t buffer) const
{
    if (buffer == kNoBuffer)
        return {};
    std::vector<std::byte> bytes(plan.buffers[buffer].bytes);
    device->read(buffers[buffer], 0, bytes);
    return bytes;
}

void World::Impl::count_step()
{
    program.end_step(scene.timestep);
    ++steps;
    guessed = parts == 1; // else it is of a shorter substep than reports take it for
    push += force_sum * scene.timestep;
}

/// Cloth that can tear is looked at between steps: one word says whether any spring is too long.
void World::Impl::after_step()
{
    count_step();
    const bool tears = plan.torn != kNoBuffer;
    const std::uint32_t count = tears ? device->read<std::uint32_t>(buffers[plan.torn], 1).front() : 0;
    const bool longer = tears && count != overlong; // asked before lists grow, which begins that count anew
    overlong = count;
    grow_contacts();
    if (given_up.tangled && !pinched_last && steps >= given_up.tried_until)
        untangle();
    if (!longer)
        return;
    const TornScene next = tear(scene, positions(all()));
    if (next.splits > 0)
        replace_scene(next);
}

namespace {

Scene resolved(const Scene& scene)
{
    for (const Body& body : scene.bodies)
        if (body.mesh.positions.empty())
            return resolve(scene);
    Scene counted = scene;
    count_steps(counted);
    return counted;
}

bool has_constraints(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return b.material.stretch_stiffness > 0 || resists_bending(b.material) || !b.springs.empty() ||
               !b.elements.empty();
    });
}

} // namespace

World::World(const Scene& scene, std::shared_ptr<Device> device, const WorldOptions& options)
    : impl_(std::make_unique<Impl>())
{
    impl_->device = required(std::move(device), "a World");
    impl_->scene = with_start(resolved(scene));
    // Costs only decide how constraints are grouped: without any, no probe runs.
    const DeviceTraits traits = options.traits                  ? *options.traits
                                : has_constraints(impl_->scene) ? measure_traits(*impl_->device)
                                                                : limits_as_traits(*impl_->device);
    impl_->options = options.plan;
    impl_->traits = traits;
    impl_->plan = make_plan(impl_->scene, traits, options.plan);
    impl_->moves = inputs_move(impl_->scene, impl_->plan);
    impl_->program.start(impl_->scene);
    moved_ = &impl_->program;
    impl_->restart_clock({});
    impl_->create_buffers();
    if (impl_->plan.force != kNoBuffer)
        impl_->keep_forces(std::vector<std::byte>(impl_->plan.buffers[impl_->plan.force].bytes));
    impl_->record();
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step()
{
    const std::vector<InputWrite> before = impl_->before_step(), inputs = impl_->take_inputs();
    if (impl_->recording)
        impl_->device->replay(*impl_->recording, writes_of(impl_->buffers, inputs));
    impl_->repeat_step(before, inputs);
    impl_->after_step();
}

std::vector<EffectTime> World::step_timed()
{
    const std::vector<InputWrite> before = impl_->before_step(), inputs = impl_->take_inputs();
    impl_->write_now(inputs);
    std::vector<EffectTime> times;
    for (const EffectCost& effect : impl_->plan.effects)
        times.push_back({effect.name, 0, 0});
    if (impl_->recording)
        for (const DispatchTime& t : impl_->recording->replay_timed())
            for (EffectTime& effect : times)
                if (effect.name == impl_->plan.passes[t.dispatch].label)
                {
                    ++effect.dispatches;
                    effect.milliseconds += t.nanoseconds * 1e-6;
                }
    impl_->repeat_step(before, inputs);
    impl_->after_step();
    return times;
}

std::uint64_t World::steps() const { return impl_->steps; }
double World::time() const { return impl_->time(); }
glm::dvec3 World::gravity_impulse() const
{
    return impl_->clock.fall + impl_->clock.gravity * (time() - impl_->clock.time);
}
WorldDrive World::drive() const
{
    const Clock& clock = impl_->clock;
    WorldDrive out{time(), impl_->plan.timestep / impl_->plan.substeps,
                   clock.fall_length + glm::length(clock.gravity) * (time() - clock.time), clock.steady,
                   impl_->push};
    const ProgramMotion& values = impl_->program.values();
    for (const ColliderMove& move : values.colliders)
        out.moved.push_back({false, move.track.reach});
    for (const PinMove& move : values.pins)
        out.moved.push_back({!impl_->scene.bodies[move.body].kinematic.used, move.track.reach});
    out.wind = values.wind ? values.wind->fastest : 0;
    out.kick = impl_->kick;
    out.placed = impl_->placings;
    return out;
}
const Plan& World::plan() const { return impl_->plan; }
const Scene& World::scene() const { return impl_->scene; }
Device& World::device() const { return *impl_->device; }

std::vector<glm::dvec3> World::displacements() const { return impl_->vectors(impl_->plan.delta); }
std::vector<glm::dvec3> World::predictions() const
{
    return impl_->guessed ? impl_->vectors(impl_->plan.predicted) : std::vector<glm::dvec3>();
}

std::vector<double> World::multipliers(std::string_view kind) const
{
    return impl_->of_constraints(kind, &ConstraintSet::multipliers);
}

std::vector<double> World::damping_times(std::string_view kind) const
{
    return impl_->of_constraints(kind, &ConstraintSet::damping);
}

Events World::events() const
{
    if (impl_->plan.events == kNoBuffer)
        return {};
    const auto counts =
        impl_->device->read<std::uint32_t>(impl_->buffers[impl_->plan.events], TAUT_EVENT_COUNT);
    return {counts[TAUT_EVENT_NON_FINITE], counts[TAUT_EVENT_SPEED_CLAMP], counts[TAUT_EVENT_DEGENERATE],
            counts[TAUT_EVENT_CONFLICT]};
}

std::uint64_t World::torn() const { return impl_->torn; }

double World::active_share() const
{
    const PlanActive& active = impl_->plan.active;
    if (active.buffer == kNoBuffer || active.candidates == 0)
        return -1;
    const auto rows = impl_->device->read<std::uint32_t>(impl_->buffers[active.buffer], 1, active.offset);
    return static_cast<double>(rows.front()) / active.candidates;
}

BufferPtr World::position_buffer() const
{
    return impl_->plan.position == kNoBuffer ? nullptr : impl_->buffers[impl_->plan.position];
}

void World::record_into(VkCommandBuffer_T* commands)
{
    if (impl_->plan.torn != kNoBuffer)
        throw Error(ErrorCode::unsupported,
                    "record_into: cloth that can tear is looked at after every step; use step(), or leave "
                    "tear_strain out");
    const std::vector<InputWrite> inputs = impl_->take_inputs();
    if (impl_->recording)
        record_into_vulkan(*impl_->recording, commands, writes_of(impl_->buffers, inputs));
    impl_->count_step();
}

void World::set_timestep(double seconds)
{
    check_timestep(seconds, impl_->plan.substeps, impl_->plan.largest_substep);
    impl_->take_timestep(seconds);
    impl_->restart_clock(Clock(impl_->clock));
}

void World::set_gravity(const glm::dvec3& gravity)
{
    if (!std::isfinite(gravity.x) || !std::isfinite(gravity.y) || !std::isfinite(gravity.z))
        throw Error(ErrorCode::bad_input, "set_gravity: a component is not finite; gravity is in m/s^2");
    const Pace before = impl_->pace();
    impl_->scene.gravity = gravity;
    impl_->move_velocities(before);
    impl_->restart_clock(Clock(impl_->clock));
    impl_->stale = true;
}

} // namespace taut
