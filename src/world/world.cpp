#include "taut/world/world.hpp"

#include "taut/linear/cg_state.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"
#include "taut/world/inputs.hpp"
#include "taut/world/tearing.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace taut {

struct World::Impl
{
    Scene scene;
    Plan plan;
    std::shared_ptr<Device> device;
    std::vector<BufferPtr> buffers;       ///< as plan.buffers
    std::unique_ptr<Recording> recording; ///< null when nothing is to be done
    std::uint64_t steps = 0;
    Clock clock;
    bool moves = false;
    PlanOptions options;
    DeviceTraits traits;
    std::uint64_t torn = 0;       ///< vertices that came apart
    std::uint32_t overlong = 0;   ///< what plan.torn counted when it was last looked at

    double time() const { return clock.at(steps); }
    void restart_clock(const Clock& before);
    void create_buffers();
    void record();
    void write_inputs();
    void write_all_inputs();
    void after_step();
    void replace_scene(const TornScene& next);
    template <typename Real>
    std::vector<glm::dvec3> read_vectors(std::uint32_t buffer, std::uint32_t added) const;
    std::vector<glm::dvec3> vectors(std::uint32_t buffer, std::uint32_t added = kNoBuffer) const;
    std::vector<std::byte> raw(std::uint32_t buffer) const;
};

void World::Impl::create_buffers()
{
    for (const PlanBuffer& buffer : plan.buffers)
    {
        buffers.push_back(device->make_buffer(
            buffer.bytes, buffer.name, buffer.host_written ? BufferUse::host_written : BufferUse::device));
        if (!buffer.initial.empty())
            device->write(buffers.back(), 0, buffer.initial);
    }
}

void World::Impl::record()
{
    if (!plan.passes.empty())
        recording = device->compile({buffers, plan.passes, plan.barrier_before});
}

/// A stretch of time with the scene's timestep and gravity, after one that may have had others.
void World::Impl::restart_clock(const Clock& before)
{
    const double time = before.at(steps);
    clock = {steps, time, scene.timestep, scene.gravity, before.fall + before.gravity * (time - before.time)};
}

void World::Impl::write_inputs()
{
    if (moves || steps == 0)
        write_all_inputs();
}

/// Inputs that do not move are written before the first step and when something changes them, only.
void World::Impl::write_all_inputs()
{
    for (const InputWrite& write : step_inputs(scene, plan, time()))
        device->write(buffers[write.buffer], 0, write.bytes);
}

template <typename Real>
std::vector<glm::dvec3> World::Impl::read_vectors(std::uint32_t buffer, std::uint32_t added) const
{
    using Vec = glm::vec<4, Real>;
    std::vector<glm::dvec3> out(plan.vertex_count);
    const auto values = device->read<Vec>(buffers[buffer], plan.vertex_count);
    for (std::uint32_t v = 0; v < plan.vertex_count; ++v)
        out[plan.original[v]] = glm::dvec3(values[v]);
    if (added == kNoBuffer)
        return out;
    const auto more = device->read<Vec>(buffers[added], plan.vertex_count);
    for (std::uint32_t v = 0; v < plan.vertex_count; ++v)
        out[plan.original[v]] += glm::dvec3(more[v]);
    return out;
}

std::vector<glm::dvec3> World::Impl::vectors(std::uint32_t buffer, std::uint32_t added) const
{
    if (buffer == kNoBuffer)
        return {};
    return plan.precision == Precision::float64 ? read_vectors<double>(buffer, added)
                                                : read_vectors<float>(buffer, added);
}

std::vector<std::byte> World::Impl::raw(std::uint32_t buffer) const
{
    if (buffer == kNoBuffer)
        return {};
    std::vector<std::byte> bytes(plan.buffers[buffer].bytes);
    device->read(buffers[buffer], 0, bytes);
    return bytes;
}

/// Cloth that can tear is looked at between steps: one word says whether any spring is too long.
void World::Impl::after_step()
{
    ++steps;
    if (plan.torn == kNoBuffer)
        return;
    const std::uint32_t count = device->read<std::uint32_t>(buffers[plan.torn], 1).front();
    if (count == overlong)
        return;
    overlong = count;
    const TornScene next = tear(scene, vectors(plan.position, plan.low));
    if (next.splits > 0)
        replace_scene(next);
}

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

/// Plans the scene anew and carries the state over, bit for bit; inverse masses are the new plan's.
void World::Impl::replace_scene(const TornScene& next)
{
    const std::vector<std::byte> position = raw(plan.position), low = raw(plan.low),
                                 velocity = raw(plan.velocity), delta = raw(plan.delta),
                                 force = raw(plan.force), events = raw(plan.events);
    std::vector<std::vector<std::byte>> logs; // of linear solves: they count over the whole run
    for (const PlanSolver& solver : plan.solvers)
        logs.push_back(raw(solver.log));
    const Plan before = std::exchange(plan, make_plan(next.scene, traits, options));
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
    device->write(buffers[plan.events], 0, events);
    for (std::size_t k = 0; k < std::min(logs.size(), plan.solvers.size()); ++k)
        device->write(buffers[plan.solvers[k].log], 0, logs[k]);
    if (plan.force != kNoBuffer)
        device->write(buffers[plan.force], 0, spread(force, from, element));
    write_all_inputs();
}

namespace {

Scene resolved(const Scene& scene)
{
    for (const Body& body : scene.bodies)
        if (body.mesh.positions.empty())
            return resolve(scene);
    return scene;
}

bool has_constraints(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return b.material.stretch_stiffness > 0 || b.material.bending_stiffness > 0 || !b.springs.empty();
    });
}

} // namespace

World::World(const Scene& scene, std::shared_ptr<Device> device, const WorldOptions& options)
    : impl_(std::make_unique<Impl>())
{
    impl_->scene = resolved(scene);
    impl_->device = std::move(device);
    // Costs only decide how constraints are grouped: without any, no probe runs.
    const DeviceTraits traits =
        has_constraints(impl_->scene) ? measure_traits(*impl_->device) : limits_as_traits(*impl_->device);
    impl_->options = options.plan;
    impl_->traits = traits;
    impl_->plan = make_plan(impl_->scene, traits, options.plan);
    impl_->moves = inputs_move(impl_->scene, impl_->plan);
    impl_->restart_clock({});
    impl_->create_buffers();
    impl_->record();
}

World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::step()
{
    impl_->write_inputs();
    if (impl_->recording)
        impl_->recording->replay();
    impl_->after_step();
}

std::vector<EffectTime> World::step_timed()
{
    impl_->write_inputs();
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
    impl_->after_step();
    return times;
}

std::uint64_t World::steps() const { return impl_->steps; }
double World::time() const { return impl_->time(); }
glm::dvec3 World::gravity_impulse() const
{
    return impl_->clock.fall + impl_->clock.gravity * (time() - impl_->clock.time);
}
const Plan& World::plan() const { return impl_->plan; }
const Scene& World::scene() const { return impl_->scene; }
Device& World::device() const { return *impl_->device; }

std::vector<glm::dvec3> World::positions() const
{
    return impl_->vectors(impl_->plan.position, impl_->plan.low);
}
std::vector<glm::dvec3> World::velocities() const { return impl_->vectors(impl_->plan.velocity); }
std::vector<glm::dvec3> World::displacements() const { return impl_->vectors(impl_->plan.delta); }
std::vector<glm::dvec3> World::predictions() const { return impl_->vectors(impl_->plan.predicted); }

std::vector<double> World::multipliers(std::string_view kind) const
{
    for (const ConstraintSet& set : impl_->plan.constraints)
    {
        if (set.kind != kind || set.multipliers == kNoBuffer)
            continue;
        const BufferPtr& buffer = impl_->buffers[set.multipliers];
        if (impl_->plan.precision == Precision::float64)
            return impl_->device->read<double>(buffer, set.count);
        const auto values = impl_->device->read<float>(buffer, set.count);
        return {values.begin(), values.end()};
    }
    return {};
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

std::uint64_t World::torn() const { return impl_->torn; }

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
    impl_->write_inputs();
    if (impl_->recording)
        record_into_vulkan(*impl_->recording, commands);
    ++impl_->steps;
}

WorldState World::state() const
{
    const Plan& plan = impl_->plan;
    WorldState out{
        impl_->steps,           impl_->raw(plan.position), impl_->raw(plan.low), impl_->raw(plan.velocity),
        impl_->raw(plan.delta), impl_->raw(plan.force),    impl_->clock};
    for (const std::uint32_t buffer : plan.kept)
        out.kept.push_back(impl_->raw(buffer));
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
        throw Error(ErrorCode::bad_input, "restore: what method \"" + impl_->scene.method.type +
                                              "\" keeps from step to step is missing or of another size: the "
                                              "state is of another scene or method");
    const Clock& clock = state.clock;
    const double sum = clock.time + clock.timestep + glm::length(clock.gravity) + glm::length(clock.fall);
    if (!std::isfinite(sum) || clock.timestep < 0 || clock.step > state.step)
        throw Error(ErrorCode::bad_input, "restore: the clock is not that of step " +
                                              std::to_string(state.step) +
                                              ": it must be finite and begin at that step or before");
    for (const auto& [buffer, bytes] : parts)
        if (buffer != kNoBuffer)
            impl_->device->write(impl_->buffers[buffer], 0, *bytes);
    for (std::size_t i = 0; i < plan.kept.size(); ++i)
        impl_->device->write(impl_->buffers[plan.kept[i]], 0, state.kept[i]);
    impl_->steps = state.step;
    const bool clocked = state.clock.timestep > 0;
    impl_->clock = clocked ? state.clock : Clock{0, 0, impl_->scene.timestep, impl_->scene.gravity};
    if (impl_->clock.timestep != impl_->scene.timestep || impl_->clock.gravity != impl_->scene.gravity)
        impl_->restart_clock(impl_->clock);
    impl_->write_all_inputs();
}

void World::set_timestep(double seconds)
{
    check_timestep(seconds, impl_->plan.substeps, impl_->plan.largest_substep);
    impl_->scene.timestep = impl_->plan.timestep = seconds;
    impl_->restart_clock(Clock(impl_->clock));
    impl_->write_all_inputs();
}

void World::set_gravity(const glm::dvec3& gravity)
{
    if (!std::isfinite(gravity.x) || !std::isfinite(gravity.y) || !std::isfinite(gravity.z))
        throw Error(ErrorCode::bad_input, "set_gravity: a component is not finite; gravity is in m/s^2");
    impl_->scene.gravity = gravity;
    impl_->restart_clock(Clock(impl_->clock));
    impl_->write_all_inputs();
}

void World::set_force(std::uint32_t vertex, const glm::dvec3& force)
{
    const Plan& plan = impl_->plan;
    if (plan.force == kNoBuffer)
        throw Error(ErrorCode::unsupported,
                    "set_force: the scene does not call for external forces; set external_forces to true");
    if (vertex >= plan.vertex_count)
        throw Error(ErrorCode::bad_input, "set_force: vertex " + std::to_string(vertex) + " of " +
                                              std::to_string(plan.vertex_count));
    if (!std::isfinite(force.x) || !std::isfinite(force.y) || !std::isfinite(force.z))
        throw Error(ErrorCode::bad_input,
                    "set_force: the force on vertex " + std::to_string(vertex) + " is not finite");
    std::uint32_t index = 0;
    while (plan.original[index] != vertex)
        ++index;
    const auto put = [&]<typename Real>(Real) {
        const glm::vec<4, Real> value(glm::vec<3, Real>(force), Real(0));
        impl_->device->write(impl_->buffers[plan.force], index * sizeof(value),
                             std::as_bytes(std::span(&value, 1)));
    };
    if (plan.precision == Precision::float64)
        put(double{});
    else
        put(float{});
}

} // namespace taut
