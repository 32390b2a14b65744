#include "taut/world/inputs.hpp"

#include "taut/plan/collider_shapes.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace taut {
namespace {

/// Speeds are squared in float: beyond this a clamp is not physics but a guard.
constexpr double kOverflowSpeed = 1e15;
/// sqrt(m): times the root of any depth it is further than `depenetration`. Nothing lies where nothing falls.
constexpr double kUnbraked = 1e15;

template <typename T>
InputWrite write_of(std::uint32_t buffer, const std::vector<T>& values)
{
    const auto bytes = std::as_bytes(std::span<const T>(values));
    return {buffer, {bytes.begin(), bytes.end()}};
}

template <typename Real>
InputWrite step_values(const Scene& scene, const Plan& plan)
{
    const double h = scene.timestep / plan.substeps;
    layout::StepValues<Real> v{};
    v.substep = static_cast<Real>(h);
    v.inverse_substep = static_cast<Real>(1 / h);
    v.gravity_x = static_cast<Real>(scene.gravity.x);
    v.gravity_y = static_cast<Real>(scene.gravity.y);
    v.gravity_z = static_cast<Real>(scene.gravity.z);
    v.damping_factor = static_cast<Real>(std::exp(-scene.damping * h));
    v.max_speed = static_cast<Real>(scene.max_speed > 0 ? scene.max_speed : kOverflowSpeed);
    v.depenetration = static_cast<Real>(std::min(scene.depenetration_speed * h, plan.way_out));
    const double g = glm::length(scene.gravity);
    v.braked = static_cast<Real>(g > 0 ? h * std::sqrt(g) : kUnbraked);
    return write_of(plan.step_values, std::vector{v});
}

template <typename Real>
InputWrite wind(const Scene& scene, const Plan& plan, const Stretch& step)
{
    const glm::dvec3 from = wind_at(scene.wind, step.from), to = wind_at(scene.wind, step.to);
    layout::WindValues<Real> w{};
    w.start_x = static_cast<Real>(from.x);
    w.start_y = static_cast<Real>(from.y);
    w.start_z = static_cast<Real>(from.z);
    w.end_x = static_cast<Real>(to.x);
    w.end_y = static_cast<Real>(to.y);
    w.end_z = static_cast<Real>(to.z);
    w.density = static_cast<Real>(scene.wind.density);
    return write_of(plan.wind, std::vector{w});
}

/// Where a pin that the program moves is to have one of its vertices, at the start and the end of the step.
std::array<glm::dvec3, 2> by_program(const ProgramMotion& program, const MovingPin& pin)
{
    const auto move = std::find_if(program.pins.begin(), program.pins.end(),
                                   [&](const PinMove& m) { return m.body == pin.body && m.pin == pin.pin; });
    if (move == program.pins.end())
        return {pin.rest, pin.rest};
    return {move->from[pin.own], move->to[pin.own]};
}

template <typename Real>
InputWrite pin_targets(const Scene& scene, const Plan& plan, const Stretch& step,
                       const ProgramMotion& program)
{
    std::vector<glm::vec<4, Real>> out;
    for (const MovingPin& moving : plan.moving_pins)
    {
        const Pin& pin = scene.bodies[moving.body].pins[moving.pin];
        const std::array<glm::dvec3, 2> ends =
            pin.moved_by_program ? by_program(program, moving)
                                 : std::array{held_at(pin, step.from, moving.own, moving.rest),
                                              held_at(pin, step.to, moving.own, moving.rest)};
        for (const glm::dvec3& end : ends)
            out.emplace_back(glm::vec<3, Real>(end), Real(0));
    }
    return write_of(plan.pin_targets, out);
}

template <typename Real>
std::vector<InputWrite> inputs(const Scene& scene, const Plan& plan, const Stretch& step,
                               const ProgramMotion& program)
{
    std::vector<InputWrite> writes;
    if (plan.step_values != kNoBuffer)
        writes.push_back(step_values<Real>(scene, plan));
    for (std::size_t row = 0; row < kColliderKinds; ++row)
        if (plan.colliders[row] != kNoBuffer)
            writes.push_back(
                {plan.colliders[row], collider_records(scene, static_cast<ColliderKind>(row), plan.precision,
                                                       plan.substeps, step.from, step.to)});
    if (plan.wind != kNoBuffer)
        writes.push_back(wind<Real>(scene, plan, step));
    if (plan.pin_targets != kNoBuffer)
        writes.push_back(pin_targets<Real>(scene, plan, step, program));
    return writes;
}

} // namespace

std::vector<std::uint32_t> words_of(const std::vector<InputWrite>& snapshot, std::uint32_t buffer)
{
    const auto found = std::find_if(snapshot.begin(), snapshot.end(),
                                    [&](const InputWrite& write) { return write.buffer == buffer; });
    std::vector<std::uint32_t> out(found->bytes.size() / sizeof(std::uint32_t));
    std::memcpy(out.data(), found->bytes.data(), found->bytes.size());
    return out;
}

bool inputs_move(const Scene& scene, const Plan& plan)
{
    const bool gusts = plan.wind != kNoBuffer && !scene.wind.keys.empty();
    const bool led = std::any_of(plan.moving_pins.begin(), plan.moving_pins.end(), [&](const MovingPin& m) {
        return !scene.bodies[m.body].pins[m.pin].moved_by_program;
    });
    return gusts || led || std::any_of(scene.colliders.begin(), scene.colliders.end(), [](const Collider& c) {
               return !c.motion.empty() && !c.moved_by_program;
           });
}

std::vector<InputWrite> step_inputs(const Scene& scene, const Plan& plan, const Stretch& step,
                                    const ProgramMotion& program)
{
    return plan.precision == Precision::float64 ? inputs<double>(scene, plan, step, program)
                                                : inputs<float>(scene, plan, step, program);
}

} // namespace taut
