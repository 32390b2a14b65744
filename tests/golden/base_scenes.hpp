#pragma once
// Golden scenes of xpbd, and bodies that others take. All are small, generated, and without host functions
// whose last bit depends on the C library (no rotations; damping only in float), so that the hashes hold on
// other machines.

#include "taut/scene/distance_field.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <limits>
#include <map>
#include <string>

namespace taut::golden {

/// A square cloth of side 1 m with its rows along -y in the plane z = 0.
inline Body cloth(const std::string& name, std::uint32_t cells)
{
    Body body;
    body.name = name;
    body.shape.cells = {cells, cells};
    return body;
}

/// Two pinned corners and nothing else; blown out of its plane.
inline Scene hanging()
{
    Scene scene;
    Body body = cloth("cloth", 12);
    body.velocity = {0.5, 0, 2};
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    return scene;
}

/// Falls edge first on a ball that it bends around and rubs on.
inline Scene drape()
{
    Scene scene;
    Body body = cloth("cloth", 14);
    body.material.bending_stiffness = 1e-4;
    body.transform.translate = {0.125, 0.75, 0.0625};
    body.velocity = {0, -1, 0.25};
    scene.bodies = {body};
    Collider ball;
    ball.name = "ball";
    ball.radius = 0.3;
    ball.friction = 0.4;
    scene.colliders = {ball};
    scene.damping = 0.5;
    return scene;
}

/// The same on a ball by its distance field.
inline Scene field()
{
    Scene scene = drape();
    DistanceField grid;
    grid.points = {17, 18, 19};
    grid.low = {-0.5, -0.53125, -0.5625};
    grid.cell = 0.0625;
    for (std::size_t k = 0; k < 19; ++k)
        for (std::size_t j = 0; j < 18; ++j)
            for (std::size_t i = 0; i < 17; ++i)
                grid.values.push_back(static_cast<float>(glm::length(grid.place(i, j, k)) - 0.3));
    Collider& ball = scene.colliders[0];
    ball.kind = ColliderKind::distance_field;
    ball.field = std::make_shared<const DistanceField>(std::move(grid));
    return scene;
}

/// A cloth with one vertex tied to most others, more than a colouring takes: a hub.
inline Scene star()
{
    Scene scene = hanging();
    Body& body = scene.bodies[0];
    constexpr std::uint32_t kMiddle = 6 * 13 + 6; // of 13 by 13 vertices
    for (std::uint32_t b = 0; b < 13 * 13; ++b)
        if (b < kMiddle - 14 || b > kMiddle + 14) // not its neighbours, which have edges to it
            body.springs.push_back({kMiddle, b, 0.5, 1e-4});
    return scene;
}

/// Rigid links, four iterations a substep.
inline Scene chain()
{
    Scene scene;
    Body body;
    body.name = "chain";
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 25;
    body.material.stretch_stiffness = std::numeric_limits<double>::infinity();
    body.velocity = {3, 0, 0};
    Pin pin;
    pin.corners = {"first"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.iterations = 4;
    scene.method.substeps = 5;
    return scene;
}

/// What the others leave out: two bodies, a moving pin, a moving ball, a plane with friction over several
/// iterations, bending by multipliers.
inline Scene busy()
{
    Scene scene = drape();
    Body flag = cloth("flag", 6);
    flag.transform.translate = {1.5, 1, 0};
    flag.material.bending_stiffness = 1e-3;
    Pin pin;
    pin.edges = {"top"};
    Keyframe from, to;
    to.time = 0.5;
    to.translate = {-0.5, 0.25, 0.5};
    pin.motion = {from, to};
    flag.pins = {pin};
    scene.bodies.push_back(flag);
    to.translate = {0.25, 0, 0};
    scene.colliders[0].motion = {from, to};
    Collider ground;
    ground.name = "ground";
    ground.kind = ColliderKind::plane;
    ground.point = {0, -0.25, 0};
    ground.friction = 0.3;
    scene.colliders.push_back(ground);
    scene.method.iterations = 3;
    scene.method.substeps = 4;
    return scene;
}

/// A soft bar held at one end. Seen along its breadth it is symmetric but for roundings, whose products are
/// denormals: a driver that keeps them ends at other bits than one that does not.
inline Scene bar()
{
    Scene scene;
    Body body;
    body.name = "bar";
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {6, 2, 2};
    body.shape.box_size = {1, 0.25, 0.25};
    body.material.youngs_modulus = 1e5;
    Pin pin;
    pin.faces = {"left"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.substeps = 4;
    return scene;
}

/// A cube that starts squeezed: a solid that nothing holds, which keeps its angular momentum.
inline Scene cube(const std::string& method)
{
    Scene scene;
    Body body;
    body.name = "cube";
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {2, 2, 2};
    body.shape.box_size = {0.2, 0.2, 0.2};
    body.material = solid_material();
    body.material.youngs_modulus = 1e5;
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 4;
    scene.method.iterations = 2;
    scene = resolve(scene);
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
        scene.bodies[0].start_positions.push_back({x.x, 0.2 * x.y + 0.3 * x.z, x.z});
    return scene;
}

} // namespace taut::golden
