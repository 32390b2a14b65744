#pragma once
// A scene whose colliders, pins and wind move by keyframes, and the same moved by the program.

#include "taut/scene/scene.hpp"
#include "taut/world/program_moves.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace taut::test {

constexpr std::size_t kMovedSteps = 24;
constexpr std::size_t kBall = 0, kFloor = 1, kCapsule = 2, kCuboid = 3;

/// Pose of a part at the end of step k; at rest at k = 0. No two steps have the same velocity.
inline Keyframe path(std::size_t part, std::size_t step)
{
    const double s = static_cast<double>(step) / kMovedSteps,
                 wave = std::sin(5 * s + static_cast<double>(part)) - std::sin(static_cast<double>(part));
    switch (part)
    {
    case kBall: return {.translate = {0.1 * wave, 0.5 * s, -0.2 * s * s}};
    case kFloor: return {.translate = {0.2 * s, 0.05 * wave, 0}};
    case kCapsule:
        return {.translate = {0, 0.3 * s, 0},
                .rotate_axis = {0, 0, 1},
                .rotate_degrees = 300 * s * s,
                .rotate_centre = {0.5, -0.3, 0}};
    case kCuboid:
        return {.translate = {0.1 * wave, 0, 0},
                .rotate_axis = {0.3, 1, 0},
                .rotate_degrees = 200 * wave,
                .rotate_centre = {-0.5, -0.3, 0}};
    default: return {.translate = {0.1 * wave, 0.2 * s, -0.3 * s}, .rotate_degrees = 40 * s};
    }
}

inline glm::dvec3 gust(std::size_t step)
{
    const double s = static_cast<double>(step) / kMovedSteps;
    return {3 * s, 0, 8 * std::sin(7 * s)};
}

/// Cloth over a ball, a floor, a capsule and a box, pinned at two corners. `by_keys`: everything moves as
/// path() says, a key a step; else nothing does until the program moves it.
inline Scene moved_scene(bool by_keys, const std::string& method = "xpbd",
                         const std::string& precision = "float")
{
    Scene scene;
    Body body;
    body.shape.cells = {8, 8};
    body.material.stretch_stiffness = 500;
    body.material.drag = 0.5;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    scene.wind.density = 1.2;
    scene.wind.velocity = gust(0);
    scene.colliders.resize(4);
    scene.colliders[kBall].point = {0, -0.31, 0};
    scene.colliders[kBall].radius = 0.3;
    scene.colliders[kFloor].kind = ColliderKind::plane;
    scene.colliders[kFloor].point = {0, -0.1, 0};
    scene.colliders[kCapsule].kind = ColliderKind::capsule;
    scene.colliders[kCapsule].point = {0.3, -0.2, -0.2};
    scene.colliders[kCapsule].end = {0.4, -0.15, 0.3};
    scene.colliders[kCapsule].radius = 0.1;
    scene.colliders[kCuboid].kind = ColliderKind::cuboid;
    scene.colliders[kCuboid].point = {-0.4, -0.12, 0.1};
    scene.colliders[kCuboid].half_size = {0.2, 0.1, 0.15};
    for (Collider& c : scene.colliders)
        c.friction = 0.4;
    Pin left, right;
    left.corners = {"top_left"};
    right.edges = {"bottom"};
    body.pins = {left, right};
    scene.timestep = 1.0 / 60;
    for (std::size_t k = 0; k <= kMovedSteps && by_keys; ++k)
    {
        const double time = static_cast<double>(k) * scene.timestep;
        const auto key = [&](std::size_t part) {
            Keyframe out = path(part, k);
            out.time = time;
            return out;
        };
        for (std::size_t c = 0; c < scene.colliders.size(); ++c)
            scene.colliders[c].motion.push_back(key(c));
        body.pins[0].motion.push_back(key(4));
        body.pins[1].motion.push_back(key(5));
        scene.wind.keys.push_back({time, gust(k)});
    }
    for (Pin& pin : body.pins)
        pin.moved_by_program = !by_keys;
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.precision = option_named<Precision>(precision);
    scene.method.substeps = 4;
    scene.method.stability = StabilityRule::ignore;
    return resolve(scene);
}

/// The orders for the step that ends as path() has it at `step`: one pin by its pose, the other vertex by
/// vertex.
template <typename World>
void order(World& world, std::size_t step, bool wind = true)
{
    world.set_collider_pose(kBall, path(kBall, step));
    const std::size_t others[] = {kFloor, kCapsule, kCuboid};
    const Keyframe poses[] = {path(kFloor, step), path(kCapsule, step), path(kCuboid, step)};
    world.set_collider_poses(others, poses);
    world.set_pin_pose(0, 0, path(4, step));
    const Body& body = world.scene().bodies[0];
    std::vector<glm::dvec3> targets;
    for (const std::uint32_t v : body.pins[1].vertices)
        targets.push_back(pose({path(5, step)}, 0, body.mesh.positions[v]));
    world.set_pin_targets(0, 1, targets);
    if (wind)
        world.set_wind(gust(step));
}

} // namespace taut::test
