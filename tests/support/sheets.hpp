#pragma once
// Sheets that meet, and what crosses while they do.

#include "support/nearest.hpp"

#include "taut/world/world.hpp"

#include <utility>
#include <vector>

namespace taut::test {

/// A square of cloth that lies level; `radius`: its thickness, m.
inline Body level_sheet(std::uint32_t cells, double size, const glm::dvec3& centre, double radius)
{
    Body body;
    body.shape.cells = {cells, cells};
    body.shape.size = {size, size};
    body.material.stretch_stiffness = 1000;
    body.material.thickness = radius;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.transform.translate = centre;
    return body;
}

/// Bodies that meet and never cross, in ten substeps a step.
inline Scene guarded_scene(std::vector<Body> bodies)
{
    Scene scene;
    scene.bodies = std::move(bodies);
    scene.contact.between = true;
    scene.contact.guarantee = Guarantee::no_crossing;
    scene.method.substeps = 10;
    return scene;
}

/// A pin of all vertices within 10 m of the origin, which goes as `motion` says.
inline void hold_all(Body& body, const std::vector<Keyframe>& motion = {})
{
    Pin pin;
    pin.use_box = true;
    pin.box_min = glm::dvec3(-10);
    pin.box_max = glm::dvec3(10);
    pin.motion = motion;
    body.pins = {pin};
}

/// Pairs of triangles that intersect after each of so many steps, added up.
inline std::size_t crossed_in(World& world, int steps)
{
    const auto triangles = all_triangles(world.scene());
    std::size_t crossed = 0;
    for (int step = 0; step < steps; ++step)
    {
        world.step();
        crossed += intersections(triangles, world.positions());
    }
    return crossed;
}

} // namespace taut::test
