#pragma once
// Golden scenes of the methods that are not xpbd, and of what they share: a cloth that swings against a ball,
// a net of springs, a box of springs with volumes.

#include "golden/base_scenes.hpp"

namespace taut::golden {

/// A cloth of springs and hinges held at two corners, which swings against a ball with friction.
inline Scene swing(const std::string& method)
{
    Scene scene;
    Body body = cloth("cloth", 8);
    body.material.stretch_stiffness = 300;
    body.material.bending_stiffness = 1e-3;
    body.velocity = {0.25, 0, -2};
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    Collider ball;
    ball.point = {0.125, -0.25, -0.5};
    ball.radius = 0.25;
    ball.friction = 0.25;
    scene.colliders = {ball};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 4;
    scene.method.iterations = 1; // of implicit_euler too
    scene.method.stability = StabilityRule::substep;
    return scene;
}

/// Provot's springs, some of which are constraints from time to time.
inline Scene network(const std::string& method)
{
    Scene scene = swing(method);
    scene.bodies[0].material.bending_stiffness = 0;
    scene.bodies[0].shape.network.used = true;
    scene.bodies[0].shape.network.structural = 100;
    scene.bodies[0].shape.network.shear = 100;
    scene.bodies[0].shape.network.bend = 10;
    scene.method.activate_strain = scene.method.release_strain = 0.02;
    return scene;
}

/// A box of springs that holds the volume of its tetrahedra, or of its surface, and falls onto the ground.
inline Scene jelly(const std::string& method, const std::string& volume)
{
    Scene scene;
    Body body;
    body.name = "jelly";
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 2, 2};
    body.shape.box_size = {0.375, 0.25, 0.25};
    body.material = solid_material();
    body.material.youngs_modulus = 2e4;
    body.material.model = SolidModel::springs;
    body.material.volume = option_named<HeldVolume>(volume);
    body.velocity = {4, -2, 0};
    scene.bodies = {body};
    Collider ground;
    ground.kind = ColliderKind::plane;
    ground.point = {0, -0.25, 0};
    ground.friction = 0.1;
    scene.colliders = {ground};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 8;
    scene.method.stability = StabilityRule::substep;
    return scene;
}

/// A scene with single settings of its method changed.
template <typename Change>
Scene with(Scene scene, const Change& change)
{
    change(scene.method);
    return scene;
}

/// One vertex weighs little beside the others: colliders hold it in further Newton steps.
inline Scene light_vertex()
{
    Scene scene = swing("implicit_euler");
    scene.method.iterations = 3;
    scene.bodies[0].vertex_masses.assign(81, 0.0025);
    scene.bodies[0].vertex_masses[40] = 0.00002;
    return scene;
}

/// Five aggregates of vertices.
inline Scene two_levels()
{
    Scene scene = swing("implicit_euler");
    scene.bodies[0].shape.cells = {16, 16};
    scene.method.preconditioner = NewtonPreconditioner::two_level;
    return scene;
}

/// Explicit Euler needs dampers, and steps that are short for them.
inline Scene damped_explicit()
{
    Scene scene = swing("mass_spring");
    scene.method.integrator = Integrator::explicit_euler;
    scene.method.substeps = 32;
    scene.bodies[0].material.stretch_damping = 0x1p-8;
    return scene;
}

/// A cloth of a fabric, which bends as before.
inline Scene woven(const std::string& method)
{
    Scene scene = swing(method);
    Material& material = scene.bodies[0].material;
    material.stretch_stiffness = 0;
    material.stretch_damping = 0;
    material.fabric.used = true;
    material.fabric.warp = 512;
    material.fabric.weft = 256;
    material.fabric.shear = 8;
    material.fabric.poissons_ratio = 0.25;
    material.fabric.grain = {1, 2, 0};
    return scene;
}

/// The same cloth, which bends as a plate, along the warp more than across.
inline Scene plate(Scene scene)
{
    Material& material = scene.bodies[0].material;
    material.bending_stiffness = 0;
    material.bending_model = BendingModel::plate;
    material.bending_poissons_ratio = 0.25;
    material.fabric.bending = {true, 0.0078125, 0.001953125, 0, BiasSpecimen::strip};
    return scene;
}

/// Every method that is not xpbd, in its forms.
inline std::map<std::string, Scene> method_scenes()
{
    using Settings = MethodSettings;
    return {
        {"mass_spring", swing("mass_spring")},
        {"mass_spring_explicit", damped_explicit()},
        {"mass_spring_verlet_slots", with(swing("mass_spring"),
                                          [](Settings& m) {
                                              m.integrator = Integrator::verlet;
                                              m.scheme = ElementScheme::spring_centric;
                                          })},
        {"mass_spring_jelly", jelly("mass_spring", "surface")},
        {"implicit_euler", swing("implicit_euler")},
        {"implicit_euler_light", light_vertex()},
        {"implicit_euler_two_level", two_levels()},
        {"implicit_euler_matrix_free",
         with(swing("implicit_euler"), [](Settings& m) { m.linear_operator = LinearOperator::matrix_free; })},
        {"implicit_constraints", swing("implicit_constraints")},
        {"implicit_constraints_structural",
         with(network("implicit_constraints"),
              [](Settings& m) { m.constrained = ConstrainedSprings::structural; })},
        {"implicit_constraints_matrix_free", with(swing("implicit_constraints"),
                                                  [](Settings& m) {
                                                      m.iterations = 2;
                                                      m.linear_operator = LinearOperator::matrix_free;
                                                  })},
        {"implicit_constraints_jelly", jelly("implicit_constraints", "tetrahedra")},
        {"cube_matrix_free",
         with(cube("implicit_euler"), [](Settings& m) { m.linear_operator = LinearOperator::matrix_free; })},
        {"pbd_star", with(star(), [](Settings& m) { m.type = MethodKind::pbd; })},
        {"acad", network("acad")},
        {"acad_compress", with(network("acad"),
                               [](Settings& m) {
                                   m.compress = true;
                                   m.release = ReleaseRule::strain;
                                   m.release_strain = 0.01;
                                   m.target = ConstraintTarget::rest;
                               })},
        {"pbd", with(swing("pbd"), [](Settings& m) { m.bend = 0.5; })},
        {"pbd_node_centric", with(swing("pbd"),
                                  [](Settings& m) {
                                      m.scheme = ElementScheme::node_centric;
                                      m.iterations = 8;
                                      m.spectral_radius = 0.5;
                                  })},
        {"pbd_constraint_centric",
         with(swing("pbd"), [](Settings& m) { m.scheme = ElementScheme::constraint_centric; })},
        {"pbd_jelly", jelly("pbd", "tetrahedra")},
        {"woven", woven("xpbd")},
        {"woven_mass_spring", woven("mass_spring")},
        {"woven_implicit_euler", woven("implicit_euler")},
        {"woven_matrix_free",
         with(woven("implicit_euler"), [](Settings& m) { m.linear_operator = LinearOperator::matrix_free; })},
        {"woven_vbd", woven("vbd")},
        {"plate", plate(woven("xpbd"))},
        {"vbd", with(swing("vbd"), [](Settings& m) { m.iterations = 4; })},
        {"vbd_accelerated", with(swing("vbd"),
                                 [](Settings& m) {
                                     m.iterations = 8;
                                     m.spectral_radius = 0.5;
                                 })},
    };
}

} // namespace taut::golden
