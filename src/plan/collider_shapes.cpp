#include "taut/plan/collider_shapes.hpp"

#include "taut/scene/collider.hpp"
#include "taut/scene/distance_field.hpp"

#include <glm/geometric.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>
#include <utility>

namespace taut {
namespace {

template <typename Real>
void fill(layout::PlaneCollider<Real>& out, const Collider& c, double from, double to)
{
    const glm::dvec3 n = glm::normalize(c.normal);
    const glm::dvec3 start = pose(c.motion, from, c.point), end = pose(c.motion, to, c.point);
    out.normal_x = static_cast<Real>(n.x);
    out.normal_y = static_cast<Real>(n.y);
    out.normal_z = static_cast<Real>(n.z);
    out.offset_start = static_cast<Real>(glm::dot(n, start));
    out.offset_end = static_cast<Real>(glm::dot(n, end));
    out.shift_x = static_cast<Real>(end.x - start.x);
    out.shift_y = static_cast<Real>(end.y - start.y);
    out.shift_z = static_cast<Real>(end.z - start.z);
}

template <typename Real>
void fill(layout::SphereCollider<Real>& out, const Collider& c, double from, double to)
{
    const glm::dvec3 start = pose(c.motion, from, c.point), end = pose(c.motion, to, c.point);
    out.start_x = static_cast<Real>(start.x);
    out.start_y = static_cast<Real>(start.y);
    out.start_z = static_cast<Real>(start.z);
    out.end_x = static_cast<Real>(end.x);
    out.end_y = static_cast<Real>(end.y);
    out.end_z = static_cast<Real>(end.z);
    out.radius = static_cast<Real>(c.radius);
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

template <typename Real>
void fill(layout::CapsuleCollider<Real>& out, const Collider& c, double at, double)
{
    const ColliderFrame frame = frame_at(c, at);
    put_frame(out, frame);
    out.half_length = static_cast<Real>(frame.half_length);
    out.radius = static_cast<Real>(c.radius);
}

template <typename Real>
void fill(layout::CuboidCollider<Real>& out, const Collider& c, double at, double)
{
    put_frame(out, frame_at(c, at));
    out.half_x = static_cast<Real>(c.half_size.x);
    out.half_y = static_cast<Real>(c.half_size.y);
    out.half_z = static_cast<Real>(c.half_size.z);
}

template <typename Real>
void fill(layout::DistanceFieldCollider<Real>& out, const Collider& c, double at, double)
{
    put_frame(out, frame_at(c, at));
    const glm::dvec3 half = c.field->half_size(); // the frame stands in the middle
    out.low_x = static_cast<Real>(-half.x);
    out.low_y = static_cast<Real>(-half.y);
    out.low_z = static_cast<Real>(-half.z);
    out.cell = static_cast<Real>(c.field->cell);
    out.count_x = c.field->points[0];
    out.count_y = c.field->points[1];
    out.count_z = c.field->points[2];
}

/// Where the values of each field begin among those of all: of one that several colliders have, once.
std::map<const DistanceField*, std::uint32_t> first_values(const Scene& scene)
{
    std::map<const DistanceField*, std::uint32_t> out;
    std::size_t first = 0; // resolve() has counted them
    for (const Collider& c : scene.colliders)
        if (c.field && out.emplace(c.field.get(), static_cast<std::uint32_t>(first)).second)
            first += c.field->values.size();
    return out;
}

template <typename Record>
void append(ColliderShape::Records& out, const Collider& collider, double from, double to,
            [[maybe_unused]] std::uint32_t first)
{
    Record record{};
    fill(record, collider, from, to);
    if constexpr (requires { record.first; })
        record.first = first;
    record.friction = static_cast<decltype(record.friction)>(collider.friction);
    const auto bytes = std::as_bytes(std::span(&record, 1));
    out.insert(out.end(), bytes.begin(), bytes.end());
}

template <template <typename> typename Record>
constexpr ColliderShape shape(std::string_view name, std::string_view kernel, bool poses, bool values = false)
{
    return {name,
            kernel,
            poses,
            values,
            sizeof(Record<float>),
            sizeof(Record<double>),
            append<Record<float>>,
            append<Record<double>>};
}

/// By ColliderKind.
constexpr ColliderShape kShapes[] = {
    shape<layout::PlaneCollider>("plane", "collide_plane", false),
    shape<layout::SphereCollider>("sphere", "collide_sphere", false),
    shape<layout::CapsuleCollider>("capsule", "collide_capsule", true),
    shape<layout::CuboidCollider>("cuboid", "collide_cuboid", true),
    shape<layout::DistanceFieldCollider>("distance_field", "collide_distance_field", true, true),
};
static_assert(std::size(kShapes) == kColliderKinds);

} // namespace

const ColliderShape& collider_shape(ColliderKind kind) { return kShapes[static_cast<std::size_t>(kind)]; }

std::uint32_t collider_count(const Scene& scene, ColliderKind kind)
{
    return static_cast<std::uint32_t>(std::count_if(scene.colliders.begin(), scene.colliders.end(),
                                                    [&](const Collider& c) { return c.kind == kind; }));
}

ColliderShape::Records collider_records(const Scene& scene, ColliderKind kind, Precision precision,
                                        std::uint32_t substeps, double from, double to)
{
    const ColliderShape& shape = collider_shape(kind);
    const auto append = precision == Precision::float64 ? shape.append_double : shape.append_float;
    ColliderShape::Records out;
    const auto first = first_values(scene);
    for (std::uint32_t s = 0; s < shape.copies(substeps); ++s)
        for (const Collider& c : scene.colliders)
            if (c.kind == kind)
                append(out, c, s == substeps ? to : from + scene.timestep * s / substeps, to,
                       c.field ? first.at(c.field.get()) : 0);
    return out;
}

std::vector<float> collider_values(const Scene& scene)
{
    std::vector<float> out;
    std::set<const DistanceField*> seen;
    for (const Collider& c : scene.colliders)
        if (c.field && seen.insert(c.field.get()).second)
            out.insert(out.end(), c.field->values.begin(), c.field->values.end());
    return out;
}

} // namespace taut
