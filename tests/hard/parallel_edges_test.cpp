// Edges of cloth that lie along a collider: which side of each other two parallel lines are is rounding.

#include "hard/cases.hpp"

namespace taut::hard {
namespace {

/// A strip of cloth that falls level onto a lying capsule, whose axis a fifth of its edges are parallel to.
Scene strip_on_capsule(std::uint32_t substeps, double bending, double friction, double turned)
{
    Scene scene;
    Body body;
    body.shape.cells = {10, 2};
    body.shape.size = {1, 0.2};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.transform.translate = {0, 0.35, 0};
    body.material.density = 1;
    body.material.stretch_stiffness = 1e5;
    body.material.bending_stiffness = bending;
    scene.bodies = {body};
    Collider capsule;
    capsule.kind = ColliderKind::capsule;
    const glm::dvec3 along(std::sin(turned), 0, std::cos(turned));
    capsule.point = glm::dvec3(0, 0.2, 0) - along;
    capsule.end = glm::dvec3(0, 0.2, 0) + along;
    capsule.radius = 0.1;
    capsule.friction = friction;
    scene.colliders = {capsule};
    scene.damping = 3;
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = substeps;
    return resolve(scene);
}

} // namespace

TEST_CASE("cloth that lands with its edges along a capsule makes no energy [hard]")
{
    for (const std::uint32_t substeps : {100u, 400u})
        for (const double bending : {0.0, 0.5})
            for (const double friction : {0.0, 0.8})
                for (const double turned : {0.0, 1e-7, 1e-5, 1e-3, 0.1})
                {
                    World world(strip_on_capsule(substeps, bending, friction, turned),
                                test_device("cpu:serial"));
                    run(world, 30);
                    const StepReport report = measure(world);
                    double lowest = 1;
                    for (const glm::dvec3& x : world.positions())
                        lowest = std::min(lowest, x.y);
                    INFO(substeps << " substeps, " << bending << " N m, friction " << friction << ", turned "
                                  << turned << ": " << report.kinetic_energy << " J, lowest " << lowest
                                  << ", " << report.reason);
                    CHECK(rank(report.status) < rank(Status::diverged));
                    CHECK(report.kinetic_energy < 0.7); // of its weight times 0.35 m
                    CHECK(lowest > -0.3);
                }
}

namespace {

/// A narrow strip that falls level onto a box whose upper face lies between two of its rows of vertices.
Scene strip_on_box(std::uint32_t substeps, double width, double half_depth, double friction)
{
    Scene scene = strip_on_capsule(substeps, 0, friction, 0);
    scene.bodies[0].shape.size.y = width;
    scene.bodies[0].mesh = {};
    Collider box;
    box.kind = ColliderKind::cuboid;
    box.point = {0.05, 0.2, 0};
    box.half_size = {0.025, 0.1, half_depth};
    box.friction = friction;
    scene.colliders = {box};
    return resolve(scene);
}

} // namespace

TEST_CASE("a narrow strip that lands along a box is held by it, and makes no energy [hard]")
{
    for (const std::uint32_t substeps : {20u, 100u, 400u})
        for (const double width : {0.01, 0.001})
            for (const double half_depth : {0.025, 0.1})
                for (const double friction : {0.0, 0.3})
                {
                    World world(strip_on_box(substeps, width, half_depth, friction),
                                test_device("cpu:serial"));
                    run(world, 12);
                    const StepReport report = measure(world);
                    double highest = 0;
                    for (const glm::dvec3& x : world.positions())
                        highest = std::max(highest, x.y);
                    INFO(substeps << " substeps, " << width << " m wide, box " << half_depth);
                    INFO(report.kinetic_energy << " J, highest " << highest << ", " << report.reason);
                    CHECK(rank(report.status) < rank(Status::diverged));
                    CHECK(report.kinetic_energy < width * 9.81 * 0.2); // a fall of 0.2 s, free of the box
                    CHECK(highest > 0.29); // of the box 0.3; free of it 0.15
                }
}

} // namespace taut::hard
