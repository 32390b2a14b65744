// Claims about closed surfaces under mass_spring that hold the volume within: F14 of docs/hard-cases.md.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sphere.hpp"

#include "taut/plan/material.hpp"
#include "taut/plan/surface.hpp"
#include "taut/report/report.hpp"
#include "taut/report/volume.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace taut;

namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

double share(const World& world) // V / V0
{
    const Mesh& mesh = world.scene().bodies[0].mesh;
    return enclosed_volume(mesh.triangles, world.positions()) /
           enclosed_volume(mesh.triangles, mesh.positions);
}

/// The sphere of 258 vertices and radius 1, half a radius above the floor.
Scene dropped(double stiffness, double volume_stiffness)
{
    Scene scene = test::ball_of_springs(8, 1, stiffness, volume_stiffness);
    scene.bodies[0].material.thickness = 0;
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -1.5, 0};
    scene.colliders = {floor};
    return scene;
}

struct Range
{
    double least = 1e300, most = -1e300;
};

Range run(World& world, int steps)
{
    Range out;
    for (int k = 0; k < steps; ++k)
    {
        world.step();
        const double now = share(world);
        out.least = std::min(out.least, now);
        out.most = std::max(out.most, now);
    }
    return out;
}

/// A block of springs, `half` its height, with or without its volume, no gravity.
Scene squeezed(bool same_volume)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.timestep = 1e-3;
    scene.method.type = MethodKind::mass_spring;
    scene.method.substeps = 1;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.material = solid_material();
    body.material.model = SolidModel::springs;
    body.material.youngs_modulus = 1e4;
    body.material.volume = HeldVolume::surface;
    body.material.volume_stiffness = kRigid;
    scene.bodies = {body};
    scene.accept.inverted = 1000; // springs do not know the inside of a tetrahedron
    Scene out = resolve(scene);
    out.bodies[0].start_positions = out.bodies[0].mesh.positions;
    const double side = same_volume ? std::sqrt(2.0) : 1;
    for (glm::dvec3& x : out.bodies[0].start_positions)
        x *= glm::dvec3(side, 0.5, side);
    return out;
}

/// Total momentum over the sum of its sizes.
double drift(const World& world)
{
    const std::vector<double> mass = vertex_masses(world.scene().bodies[0]);
    const std::vector<glm::dvec3> v = world.velocities();
    glm::dvec3 sum(0);
    double size = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
    {
        sum += mass[k] * v[k];
        size += mass[k] * glm::length(v[k]);
    }
    return glm::length(sum) / size;
}

} // namespace

TEST_CASE("a ball dropped on the floor keeps 99.9 % of its volume, of which springs alone lose up to all",
          "[surface_volume]")
{
    const double stiffness = GENERATE(50.0, 200.0, 1000.0);
    CAPTURE(stiffness);
    World free(dropped(stiffness, 0), test_device("cpu:serial"));
    const Range without = run(free, 3000);
    World held(dropped(stiffness, kRigid), test_device("cpu:serial"));
    const Range with = run(held, 3000);
    INFO("lowest V/V0: " << without.least << " without, " << with.least << " to " << with.most << " with");
    CHECK(without.least < (stiffness > 500 ? 0.95 : 0.5));
    CHECK(with.least > 0.999);
    CHECK(with.most < 1.001);
    CHECK(measure(held).status == Status::completed);
}

TEST_CASE("every integrator holds the volume, in float and double", "[surface_volume]")
{
    const std::string integrator = GENERATE("semi_implicit", "explicit", "verlet");
    const std::string precision = GENERATE("float", "double");
    CAPTURE(integrator, precision);
    Scene scene = dropped(200, kRigid);
    scene.method.integrator = option_named<Integrator>(integrator);
    scene.method.precision = option_named<Precision>(precision);
    scene.bodies[0].material.stretch_damping = 2e-3; // or explicit Euler gains energy from every spring
    World world(scene, test_device("cpu:serial"));
    const Range range = run(world, 1500);
    INFO(range.least << " to " << range.most);
    CHECK(range.least > 0.999);
    CHECK(range.most < 1.001);
}

TEST_CASE("executors agree on a ball that hits the floor", "[surface_volume]")
{
    Scene scene = dropped(200, 1e4);
    scene.method.iterations = 2;
    World reference(scene, test_device("cpu:serial"));
    for (int k = 0; k < 400; ++k)
        reference.step();
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        World world(scene, test_device(selector));
        for (int k = 0; k < 400; ++k)
            world.step();
        double apart = 0;
        for (std::size_t v = 0; v < world.positions().size(); ++v)
            apart = std::max(apart, glm::distance(world.positions()[v], reference.positions()[v]));
        CHECK(apart < (test_device(selector)->info().hardware_gpu ? 1e-3 : 1e-12));
        CHECK(test_device(selector)->counters().validation_messages == 0);
    }
}

TEST_CASE("a block squeezed to half its height and let go keeps its volume and its momentum (F14)",
          "[surface_volume]")
{
    World world(squeezed(true), test_device("cpu:serial"));
    Range range;
    double worst = 0;
    for (int k = 0; k < 2000; ++k)
    {
        world.step();
        range.least = std::min(range.least, share(world));
        range.most = std::max(range.most, share(world));
        worst = std::max(worst, drift(world));
    }
    INFO(range.least << " to " << range.most << ", momentum " << worst << "; " << measure(world).reason);
    CHECK(range.least > 0.99);
    CHECK(range.most < 1.01);
    CHECK(worst < 1e-5);
    CHECK(measure(world).status == Status::completed);
}

TEST_CASE("a block that starts with half its volume has it back after a step of some iterations",
          "[surface_volume]")
{
    Scene scene = squeezed(false);
    scene.damping = 5; // what comes back in a step of a millisecond is fast
    scene.method.iterations = 6;
    World world(scene, test_device("cpu:serial"));
    world.step();
    CHECK(std::abs(share(world) - 1) < 1e-3);
    const Range range = run(world, 2000);
    INFO(range.least << " to " << range.most);
    CHECK(range.least > 0.99);
    CHECK(range.most < 1.01);
    CHECK(measure(world).status == Status::completed);
}

TEST_CASE("a hundred metres from the origin float holds the volume as well", "[surface_volume]")
{
    Scene scene = dropped(200, kRigid);
    const glm::dvec3 far(100, 50, -100);
    for (glm::dvec3& x : scene.bodies[0].mesh.positions)
        x += far;
    scene.colliders[0].point += far;
    World world(scene, test_device("cpu:serial"));
    const Range range = run(world, 3000);
    INFO(range.least << " to " << range.most);
    CHECK(range.least > 0.999);
    CHECK(range.most < 1.001);
}

TEST_CASE("pressure of a compliant volume carries the load that its bulk modulus says", "[surface_volume]")
{
    // A sphere pulled out by a tenth, without springs: C + alpha lambda = 0 swings about V0, and 2 iterations
    // of a step find the same multiplier as one does where the volume is linear enough.
    Scene scene = test::ball_of_springs(8, 1, 1e-3, 1e3);
    scene.gravity = {0, 0, 0};
    scene.method.precision = Precision::float64;
    scene.timestep = 1e-5;
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x *= 1.01;
    const double volume = enclosed_volume(scene.bodies[0].mesh.triangles, scene.bodies[0].mesh.positions);
    for (const std::uint32_t iterations : {1u, 3u})
    {
        scene.method.iterations = iterations;
        World world(scene, test_device("cpu:serial"));
        world.step();
        // p = K (V - V0) / V0, and the area vector of a vertex is its gradient: a = -p g / m.
        const double pressure =
            1e3 * (enclosed_volume(scene.bodies[0].mesh.triangles, world.positions()) / volume - 1);
        std::vector<glm::dvec3> g(scene.bodies[0].mesh.positions.size(), glm::dvec3(0));
        add_volume_gradient(scene.bodies[0].mesh.triangles, world.positions(), 1, g);
        for (std::size_t v = 0; v < g.size(); v += 17)
        {
            const double expected = 1e-5 * pressure * glm::length(g[v]) * static_cast<double>(g.size());
            CHECK(glm::length(world.velocities()[v]) == Approx(expected).epsilon(1e-3));
        }
    }
}
