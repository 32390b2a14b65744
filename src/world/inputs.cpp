#include "taut/world/inputs.hpp"

#include "taut/scene/collider.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace taut {
namespace {

/// Speeds are squared in float: beyond this a clamp is not physics but a guard.
constexpr double kOverflowSpeed = 1e15;

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
    return write_of(plan.step_values, std::vector{v});
}

template <typename Real>
InputWrite planes(const Scene& scene, const Plan& plan, double time)
{
    std::vector<layout::PlaneCollider<Real>> out;
    for (const Collider& c : scene.colliders)
    {
        if (c.kind != ColliderKind::plane)
            continue;
        const glm::dvec3 n = glm::normalize(c.normal);
        const glm::dvec3 from = pose(c.motion, time, c.point),
                         to = pose(c.motion, time + scene.timestep, c.point);
        layout::PlaneCollider<Real> p{};
        p.normal_x = static_cast<Real>(n.x);
        p.normal_y = static_cast<Real>(n.y);
        p.normal_z = static_cast<Real>(n.z);
        p.offset_start = static_cast<Real>(glm::dot(n, from));
        p.offset_end = static_cast<Real>(glm::dot(n, to));
        p.shift_x = static_cast<Real>(to.x - from.x);
        p.shift_y = static_cast<Real>(to.y - from.y);
        p.shift_z = static_cast<Real>(to.z - from.z);
        p.friction = static_cast<Real>(c.friction);
        out.push_back(p);
    }
    return write_of(plan.planes, out);
}

template <typename Real>
InputWrite spheres(const Scene& scene, const Plan& plan, double time)
{
    std::vector<layout::SphereCollider<Real>> out;
    for (const Collider& c : scene.colliders)
    {
        if (c.kind != ColliderKind::sphere)
            continue;
        const glm::dvec3 from = pose(c.motion, time, c.point),
                         to = pose(c.motion, time + scene.timestep, c.point);
        layout::SphereCollider<Real> s{};
        s.start_x = static_cast<Real>(from.x);
        s.start_y = static_cast<Real>(from.y);
        s.start_z = static_cast<Real>(from.z);
        s.end_x = static_cast<Real>(to.x);
        s.end_y = static_cast<Real>(to.y);
        s.end_z = static_cast<Real>(to.z);
        s.radius = static_cast<Real>(c.radius);
        s.friction = static_cast<Real>(c.friction);
        out.push_back(s);
    }
    return write_of(plan.spheres, out);
}

template <typename Record>
void put_frame(Record& out, const ColliderFrame& frame)
{
    using Real = decltype(out.centre_x);
    const std::pair<glm::dvec3, std::array<Real*, 3>> parts[] = {
        {frame.centre, {&out.centre_x, &out.centre_y, &out.centre_z}},
        {frame.x, {&out.x_x, &out.x_y, &out.x_z}},
        {frame.y, {&out.y_x, &out.y_y, &out.y_z}},
        {frame.z, {&out.z_x, &out.z_y, &out.z_z}},
    };
    for (const auto& [from, to] : parts)
        for (int axis = 0; axis < 3; ++axis)
            *to[static_cast<std::size_t>(axis)] = static_cast<Real>(from[axis]);
}

/// `fill(record, collider, frame)` of every collider of a kind, at the start of each substep and at the end.
template <typename Record, typename Fill>
InputWrite poses(const Scene& scene, const Plan& plan, double time, ColliderKind kind, std::uint32_t buffer,
                 const Fill& fill)
{
    std::vector<Record> out;
    for (std::uint32_t s = 0; s <= plan.substeps; ++s)
        for (const Collider& c : scene.colliders)
            if (c.kind == kind)
            {
                const ColliderFrame frame = frame_at(c, time + scene.timestep * s / plan.substeps);
                put_frame(out.emplace_back(Record{}), frame);
                fill(out.back(), c, frame);
            }
    return write_of(buffer, out);
}

template <typename Real>
InputWrite capsules(const Scene& scene, const Plan& plan, double time)
{
    using Record = layout::CapsuleCollider<Real>;
    return poses<Record>(scene, plan, time, ColliderKind::capsule, plan.capsules,
                         [](Record& out, const Collider& c, const ColliderFrame& frame) {
                             out.half_length = static_cast<Real>(frame.half_length);
                             out.radius = static_cast<Real>(c.radius);
                             out.friction = static_cast<Real>(c.friction);
                         });
}

template <typename Real>
InputWrite cuboids(const Scene& scene, const Plan& plan, double time)
{
    using Record = layout::CuboidCollider<Real>;
    return poses<Record>(scene, plan, time, ColliderKind::cuboid, plan.cuboids,
                         [](Record& out, const Collider& c, const ColliderFrame&) {
                             out.half_x = static_cast<Real>(c.half_size.x);
                             out.half_y = static_cast<Real>(c.half_size.y);
                             out.half_z = static_cast<Real>(c.half_size.z);
                             out.friction = static_cast<Real>(c.friction);
                         });
}

template <typename Real>
InputWrite wind(const Scene& scene, const Plan& plan, double time)
{
    const glm::dvec3 from = wind_at(scene.wind, time), to = wind_at(scene.wind, time + scene.timestep);
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

template <typename Real>
InputWrite pin_targets(const Scene& scene, const Plan& plan, double time)
{
    std::vector<glm::vec<4, Real>> out;
    for (const MovingPin& pin : plan.moving_pins)
    {
        const auto& motion = scene.bodies[pin.body].pins[pin.pin].motion;
        for (const double t : {time, time + scene.timestep})
            out.emplace_back(glm::vec<3, Real>(pose(motion, t, pin.rest)), Real(0));
    }
    return write_of(plan.pin_targets, out);
}

template <typename Real>
std::vector<InputWrite> inputs(const Scene& scene, const Plan& plan, double time)
{
    std::vector<InputWrite> writes;
    if (plan.step_values != kNoBuffer)
        writes.push_back(step_values<Real>(scene, plan));
    if (plan.planes != kNoBuffer)
        writes.push_back(planes<Real>(scene, plan, time));
    if (plan.spheres != kNoBuffer)
        writes.push_back(spheres<Real>(scene, plan, time));
    if (plan.capsules != kNoBuffer)
        writes.push_back(capsules<Real>(scene, plan, time));
    if (plan.cuboids != kNoBuffer)
        writes.push_back(cuboids<Real>(scene, plan, time));
    if (plan.wind != kNoBuffer)
        writes.push_back(wind<Real>(scene, plan, time));
    if (plan.pin_targets != kNoBuffer)
        writes.push_back(pin_targets<Real>(scene, plan, time));
    return writes;
}

} // namespace

bool inputs_move(const Scene& scene, const Plan& plan)
{
    const bool gusts = plan.wind != kNoBuffer && !scene.wind.keys.empty();
    return gusts || !plan.moving_pins.empty() || std::any_of(scene.colliders.begin(), scene.colliders.end(),
                                                    [](const Collider& c) { return !c.motion.empty(); });
}

std::vector<InputWrite> step_inputs(const Scene& scene, const Plan& plan, double time)
{
    return plan.precision == Precision::float64 ? inputs<double>(scene, plan, time)
                                                : inputs<float>(scene, plan, time);
}

} // namespace taut
