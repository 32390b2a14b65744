#include "taut/report/touching.hpp"

#include "taut/report/contact.hpp"
#include "taut/report/crossing_shapes.hpp"

#include <algorithm>

namespace taut {
namespace {

struct Placed
{
    const Scene& scene;
    const PhysicalModel& model;
    std::span<const glm::dvec3> x;
    double time;
};

/// Of a cell: between the points of a grid the way out is not quite the slope of the distance: vertices rest
/// that far beside the surface. Without it examples/scenes/distance_field.json ends with a primal residual
/// of 55, what the ring carries; with it of 0.65.
constexpr double kOffGrid = 2e-3;

/// Marks the corners of a body's triangles that a collider holds: no further from it than `near` of a corner.
template <typename Near>
void mark_held_triangles(const Placed& at, std::size_t body, const Collider& collider, const Near& near,
                         std::vector<bool>& marks)
{
    const SolidShape shape = solid_shape(collider);
    const ColliderFrame frame = frame_at(collider, at.time);
    const std::size_t first = at.model.body_start[body];
    for (const auto& [a, b, c] : at.scene.bodies[body].mesh.triangles)
    {
        const std::size_t corner[] = {first + a, first + b, first + c};
        TriangleCorners own;
        double way = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
            own[k] = frame.inside(at.x[corner[k]]);
            way = std::max(way, near(corner[k]));
        }
        if (comes_near(shape, own, way))
            for (const std::size_t v : corner)
                marks[v] = true;
    }
}

} // namespace

std::vector<bool> touching_colliders(const Scene& scene, std::span<const Collider> colliders,
                                     const PhysicalModel& model, std::span<const glm::dvec3> x, double time,
                                     std::span<const double> ways)
{
    const Placed at{scene, model, x, time};
    const auto near = [&](std::size_t i) {
        return model.gap[i] + 1e-6 * model.diameter + (ways.empty() ? 0 : ways[i]);
    };
    std::vector<bool> out(x.size(), false);
    std::vector<SurfaceRule> rules(scene.bodies.begin(), scene.bodies.end());
    for (const Collider& c : colliders)
    {
        const double beside = c.field ? kOffGrid * c.field->cell : 0;
        const reference::Surface surface = reference::surface_at(c, time);
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = out[i] || surface.touch(x[i], 0).height <= near(i) + beside;
        for (std::size_t b = 0; b < scene.bodies.size(); ++b)
            if (rules[b].meets(c))
                mark_held_triangles(at, b, c, near, out);
    }
    return out;
}

} // namespace taut
