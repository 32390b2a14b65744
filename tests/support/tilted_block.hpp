#pragma once
// A block that lies on posts narrower than it, whose tops are tilted, and how fast a body goes as a whole.

#include "taut/plan/material.hpp"
#include "taut/world/world.hpp"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <vector>

namespace taut::test {

/// Rubber of 60 cm x 20 cm x 60 cm, its lower face in the middle 10 cm above the origin along the tilted
/// normal, less 0.1 mm of air. Tilted by degrees about z.
inline Body tilted_block(double degrees, std::uint32_t cells)
{
    Body block;
    block.shape.kind = ShapeKind::box;
    block.shape.box_cells = {cells, 1, cells};
    block.shape.box_size = {0.6, 0.2, 0.6};
    block.material.youngs_modulus = 1e6;
    block.material.model = SolidModel::neo_hookean;
    block.material.density = 1000;
    const double tilt = glm::radians(degrees);
    block.transform.rotate_axis = {0, 0, 1};
    block.transform.rotate_degrees = degrees;
    block.transform.translate = glm::dvec3(-std::sin(tilt), std::cos(tilt), 0) * 0.2001;
    return block;
}

/// A box with its middle there, tilted likewise.
inline Collider tilted_post(double degrees, const glm::dvec3& middle, const glm::dvec3& half, double friction)
{
    Collider post;
    post.kind = ColliderKind::cuboid;
    post.point = middle;
    post.half_size = half;
    post.rotate_axis = {0, 0, 1};
    post.rotate_degrees = degrees;
    post.friction = friction;
    return post;
}

/// m/s, of the first body's centre of mass.
inline glm::dvec3 mean_velocity(const World& world)
{
    const std::vector<double> mass = vertex_masses(world.scene().bodies[0]);
    const std::vector<glm::dvec3> v = world.velocities();
    glm::dvec3 momentum(0);
    double all = 0;
    for (std::size_t i = 0; i < mass.size(); ++i)
    {
        momentum += mass[i] * v[i];
        all += mass[i];
    }
    return momentum / all;
}

} // namespace taut::test
