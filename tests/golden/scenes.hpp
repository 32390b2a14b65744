#pragma once
// The scenes of the golden hashes, all of them.

#include "golden/method_scenes.hpp"

#include <limits>

namespace taut::golden {

/// The surface of a cube of 2 x 2 x 2 cells as cloth: closed, wound outwards.
inline Body balloon(const std::string& name, const glm::dvec3& centre)
{
    Body body;
    body.name = name;
    body.shape.kind = ShapeKind::mesh;
    const Mesh box = make_box({2, 2, 2}, {0.5, 0.5, 0.5}, true);
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::array<std::uint32_t, 3> t : box.triangles)
    {
        for (std::uint32_t& v : t)
        {
            const auto [at, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(number.size()));
            if (is_new)
                body.mesh.positions.push_back(box.positions[v] + centre);
            v = at->second;
        }
        body.mesh.triangles.push_back(t);
    }
    body.material.stretch_stiffness = 300;
    return body;
}

/// The effects that the other scenes leave out, all at once: wind, forces of the program, gas, strain
/// limits, attachments, capsules, cuboids, plastic solids.
inline Scene effects()
{
    Scene scene = swing("xpbd");
    scene.external_forces = true;
    scene.wind.density = 1.25;
    scene.wind.velocity = {2, 0, 1};
    Material& material = scene.bodies[0].material;
    material.drag = 1;
    material.friction_drag = 0.125;
    material.strain_limit = 0.0625;
    material.attachment_slack = 0.03125;
    Body gas = balloon("gas", {-1.5, 0, 0});
    gas.material.pressure = 100;
    gas.material.pressure_law = PressureLaw::isothermal;
    gas.velocity = {0, 0, 0.5};
    Body wax = bar().bodies[0];
    wax.name = "wax";
    wax.pins.clear();
    wax.material.youngs_modulus = 2e4;
    wax.material.plastic_yield = 0.015625;
    wax.material.plastic_creep = std::numeric_limits<double>::infinity();
    wax.material.plastic_limit = 0.5;
    wax.transform.translate = {3, 0, 0};
    scene.bodies.push_back(wax);
    Collider capsule, block;
    capsule.kind = ColliderKind::capsule;
    capsule.point = {-1.75, -0.5, -0.25};
    capsule.end = {-1.25, -0.5, 0.25};
    capsule.radius = 0.125;
    capsule.friction = 0.25;
    block.kind = ColliderKind::cuboid;
    block.point = {2.25, -0.5, 0};
    block.half_size = {1, 0.25, 0.25};
    capsule.meets = block.meets = ColliderMeets::vertices; // faces() has the rest
    scene.colliders.insert(scene.colliders.end(), {capsule, block});
    scene = resolve(scene);
    scene.bodies.push_back(gas); // it has its mesh
    return scene;
}

/// A cloth on the field of a ball, and a solid that falls on a floor, a capsule and a box that turns: all
/// shapes that vertex block descent meets in its sweeps, but for balls.
inline Scene landings()
{
    Scene scene = field();
    scene.method.type = MethodKind::vbd;
    scene.method.iterations = 2;
    Body solid = cube("vbd").bodies[0];
    solid.start_positions.clear();
    solid.transform.translate = {3, 0, 0};
    solid.velocity = {0.5, -2, 0};
    scene.bodies.push_back(solid);
    Collider floor, capsule, block;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -0.25, 0};
    floor.friction = 0.25;
    capsule.kind = ColliderKind::capsule;
    capsule.point = {2.875, -0.25, -0.5};
    capsule.end = {2.875, -0.25, 0.5};
    capsule.radius = 0.0625;
    block.kind = ColliderKind::cuboid;
    block.point = {3.25, -0.25, 0};
    block.half_size = {0.125, 0.125, 0.5};
    block.rotate_axis = {0, 0, 1};
    block.rotate_degrees = 15;
    block.friction = 0.5;
    scene.colliders.insert(scene.colliders.end(), {floor, capsule, block});
    return scene;
}

/// Coarse cloths that fall onto a ball, a capsule and a turned box that goes up, each less wide than a cell.
inline Scene faces()
{
    Scene scene;
    const double at[] = {-1.5, 0, 1.5};
    Collider ball, capsule, block;
    ball.radius = 0.0625;
    ball.friction = 0.25;
    capsule.kind = ColliderKind::capsule;
    capsule.end = {0.5, 0.0625, 0.125};
    capsule.radius = 0.03125;
    capsule.friction = 0.5;
    block.kind = ColliderKind::cuboid;
    block.half_size = {0.0625, 0.125, 0.0625};
    block.rotate_axis = {1, 0, -1};
    block.rotate_degrees = 30;
    block.motion = {{0, {0, 0, 0}}, {1, {0, 0.5, 0}}};
    scene.colliders = {ball, capsule, block};
    for (std::size_t k = 0; k < 3; ++k)
    {
        Body sheet = cloth("sheet " + std::to_string(k), 3);
        sheet.pins.clear();
        sheet.material.thickness = 0.01;
        sheet.transform.rotate_axis = {1, 0, 0};
        sheet.transform.rotate_degrees = -90;
        sheet.transform.translate = {at[k], 0.1875, 0.0625};
        sheet.velocity = {0.5, -2, 0};
        scene.bodies.push_back(sheet);
        scene.colliders[k].point += glm::dvec3(at[k], 0, 0);
        scene.colliders[k].end += glm::dvec3(at[k], 0, 0);
    }
    scene.method.substeps = 8;
    return scene;
}

/// A cloth that folds over a ball onto itself, and a small one that falls onto it and rubs.
inline Scene contact()
{
    Scene scene;
    Body below = cloth("below", 8), above = cloth("above", 4);
    below.transform.translate = {0, 0.5, 0.0625};
    below.material.thickness = above.material.thickness = 0.01;
    below.contact.self = true;
    below.velocity = {0, -1, 0};
    above.shape.size = {0.25, 0.25};
    above.transform.translate = {0.125, 0.25, 0.125};
    above.velocity = {0, 0, -2};
    scene.bodies = {below, above};
    scene.contact.between = true;
    scene.contact.friction = 0.25;
    Collider ball;
    ball.radius = 0.25;
    scene.colliders = {ball};
    scene.method.substeps = 8;
    return scene;
}

/// The same and another small one, which passes through the first and rubs on the large one alone.
inline Scene grouped()
{
    Scene scene = contact();
    Body ghost = scene.bodies[1];
    ghost.name = "ghost";
    ghost.transform.translate += glm::dvec3(-0.0625, 0.03125, 0.03125);
    ghost.contact.group = "ghost";
    ghost.contact.friction = 0.75;
    scene.bodies.push_back(ghost);
    scene.bodies[1].contact.group = "above";
    scene.bodies[1].contact.passes = {"ghost"};
    scene.contact.friction_mix = FrictionMix::geometric_mean;
    return scene;
}

/// The same as the first, thrown so fast that ways have to be cut.
inline Scene guarded()
{
    Scene scene = contact();
    scene.bodies[1].velocity = {0, 0, -16};
    scene.contact.guarantee = Guarantee::no_crossing;
    return scene;
}

/// The same under another method.
inline Scene guarded_by(const std::string& method)
{
    Scene scene = guarded();
    scene.method.type = option_named<MethodKind>(method);
    scene.method.iterations = 1;
    scene.method.stability = StabilityRule::substep;
    return scene;
}

/// A block that is thrown onto a held bar and a cloth beneath both.
inline Scene solids_meet()
{
    Scene scene = bar();
    Body block = bar().bodies[0], below = cloth("below", 6);
    block.name = "block";
    block.pins.clear();
    block.shape.box_cells = {2, 2, 2};
    block.shape.box_size = {0.25, 0.25, 0.25};
    block.transform.translate = {0.25, 0.375, 0.0625};
    block.velocity = {0.5, -4, 0};
    below.transform.translate = {0, -0.25, 0};
    scene.bodies.insert(scene.bodies.end(), {block, below});
    for (Body& body : scene.bodies)
        body.material.thickness = 0.01;
    scene.contact.between = true;
    scene.contact.friction = 0.25;
    scene.contact.sweeps = 2;
    scene.method.substeps = 8;
    return scene;
}

/// A block that slides on a cloth on a plane, with enough sweeps for them to have momentum.
inline Scene laden()
{
    Scene scene = solids_meet();
    Body block = scene.bodies[1], below = scene.bodies[2];
    below.material.density = 0.5;
    below.transform.translate = {0.25, 0.015625, 0};
    below.transform.rotate_axis = {1, 0, 0};
    below.transform.rotate_degrees = 90;
    block.transform.translate = {0.25, 0.1875, 0.0625};
    block.velocity = {1, -0.5, 0};
    scene.bodies = {block, below};
    Collider plane;
    plane.kind = ColliderKind::plane;
    plane.friction = 0.0625;
    scene.colliders = {plane};
    scene.contact.friction = 0.0625;
    scene.contact.sweeps = 16;
    scene.method.substeps = 12;
    return scene;
}

/// A weak cloth, held at its top, tears under a heavy row at its end.
inline Scene tear()
{
    Scene scene = hanging();
    Body& body = scene.bodies[0];
    body.shape.cells = {8, 8};
    body.material.stretch_stiffness = 40;
    body.material.tear_strain = 0.125;
    body.pins[0].corners = {};
    body.pins[0].edges = {"top"};
    body.velocity = {0, -1, 0.5};
    body.vertex_masses.assign(81, 0.003);
    for (std::size_t v = 72; v < 77; ++v)
        body.vertex_masses[v] = 0.05;
    return scene;
}

inline Scene in_double(Scene scene)
{
    scene.method.precision = Precision::float64;
    scene.damping = 0;
    return scene;
}

inline std::map<std::string, Scene> scenes()
{
    std::map<std::string, Scene> all = method_scenes();
    all.merge(
        std::map<std::string, Scene>{{"effects", effects()},
                                     {"tear", tear()},
                                     {"contact", contact()},
                                     {"grouped", grouped()},
                                     {"guarded", guarded()},
                                     {"guarded_pbd", guarded_by("pbd")},
                                     {"guarded_vbd", guarded_by("vbd")},
                                     {"guarded_implicit_euler", guarded_by("implicit_euler")},
                                     {"guarded_mass_spring", guarded_by("mass_spring")},
                                     {"guarded_implicit_constraints", guarded_by("implicit_constraints")},
                                     {"solids_meet", solids_meet()},
                                     {"laden", laden()},
                                     {"jelly", jelly("xpbd", "tetrahedra")},
                                     {"hanging", hanging()},
                                     {"drape", drape()},
                                     {"field", field()},
                                     {"faces", faces()},
                                     {"chain", chain()},
                                     {"busy", busy()},
                                     {"star", star()},
                                     {"bar", bar()},
                                     {"cube", cube("xpbd")},
                                     {"cube_vbd", cube("vbd")},
                                     {"landings", landings()},
                                     {"cube_implicit_euler", cube("implicit_euler")},
                                     {"hanging_double", in_double(hanging())},
                                     {"drape_double", in_double(drape())}});
    return all;
}

} // namespace taut::golden
