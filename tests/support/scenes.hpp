#pragma once
// Scenes that several tests use.

#include "taut/scene/scene.hpp"

#include <string>

namespace taut::test {

/// A square metre of cloth of n x n cells hung by its two upper corners; nothing else.
inline Scene hanging(std::uint32_t n = 8)
{
    Scene scene;
    Body body;
    body.shape.cells = {n, n};
    body.material.stretch_stiffness = 1000;
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    return resolve(scene);
}

/// Cloth with every effect of the table.
inline Scene everything(std::uint32_t n = 8)
{
    Scene scene;
    Body body;
    body.shape.cells = {n, n};
    body.material.bending_stiffness = 1e-5;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.corners = {"top_left"};
    pin.motion = {{0, {0, 0, 0}}, {1, {0, 0.3, 0}}};
    body.pins = {pin};
    scene.bodies = {body};
    Collider ball;
    ball.point = {0, -0.35, 0};
    ball.radius = 0.3;
    ball.friction = 0.3;
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -0.5, 0};
    floor.friction = 0.5;
    scene.colliders = {ball, floor};
    scene.damping = 0.1;
    scene.external_forces = true;
    scene.method.iterations = 2;
    return resolve(scene);
}

/// A chain of links hung by its first vertex.
inline Scene chain(std::uint32_t links, double stiffness_per_link, double link_mass, double length = 1)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = links;
    body.shape.length = length;
    body.shape.width = 0.01;
    body.material.stretch_stiffness = stiffness_per_link * (length / links) / body.shape.width;
    body.vertex_masses.assign(links + 1, link_mass);
    Pin pin;
    pin.corners = {"first"};
    body.pins = {pin};
    scene.bodies = {body};
    return resolve(scene);
}

} // namespace taut::test
