// Solids that meet solids and cloth (docs/contact.md): they are carried, keep their momentum, and stay apart.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"

#include "taut/plan/material.hpp"
#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

using namespace taut;

namespace {

constexpr double kGravity = 9.81, kDensity = 1000, kRadius = 0.004;

Body cube(double size, std::uint32_t cells, const glm::dvec3& centre, double modulus = 2e5)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {cells, cells, cells};
    body.shape.box_size = glm::dvec3(size);
    body.material = solid_material();
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = 0.4;
    body.material.density = kDensity;
    body.material.thickness = kRadius;
    body.transform.translate = centre;
    return body;
}

/// Cubes of 0.2 m, one on the other, the lowest on a floor at 0.
Scene stack(std::size_t count, double modulus)
{
    Scene scene;
    for (std::size_t k = 0; k < count; ++k)
        scene.bodies.push_back(
            cube(0.2, 2, {0, kRadius + 0.1 + double(k) * (0.2 + 2 * kRadius), 0}, modulus));
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.friction = 0.5;
    scene.colliders = {floor};
    scene.damping = 2;
    scene.contact.between = true;
    scene.contact.friction = 0.4;
    scene.method.substeps = 20;
    return scene;
}

/// Of masses, about the origin: sums of m v and of m x cross v.
std::pair<glm::dvec3, glm::dvec3> momenta(const World& world)
{
    const auto x = world.positions(), v = world.velocities();
    std::pair<glm::dvec3, glm::dvec3> sums{glm::dvec3(0), glm::dvec3(0)};
    std::size_t i = 0;
    for (const Body& body : world.scene().bodies)
        for (const double mass : vertex_masses(body))
        {
            sums.first += mass * v[i];
            sums.second += mass * glm::cross(x[i], v[i]);
            ++i;
        }
    return sums;
}

} // namespace

TEST_CASE("a stack of solids stands, and each carries what lies above it")
{
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler");
    const double modulus = GENERATE(2e5, 1e7);
    CAPTURE(method, modulus);
    World world(test::under(stack(3, modulus), method), test_device("cpu:serial"));
    CHECK(test::crossed_in(world, 150) == 0);
    const double weight = kDensity * 0.2 * 0.2 * 0.2 * kGravity;
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 2);
    for (const BodyContactForce& force : forces)
    {
        CAPTURE(force.a, force.b, force.force.y);
        REQUIRE(force.b == force.a + 1);
        // On the lower body, by what is above it.
        CHECK(std::abs(std::abs(force.force.y) - weight * (2 - force.a)) < 0.02 * weight);
    }
    const StepReport report = measure(world);
    CHECK(report.status == Status::completed);
    CHECK(report.contact_depth < 0.1 * kRadius);
}

TEST_CASE("a solid that is not to meet the one below it falls into it")
{
    Scene scene = stack(2, 2e5);
    scene.contact.between = false;
    World world(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(world, 60) > 0);
}

TEST_CASE("two solids that collide off their centres turn, and keep both momenta")
{
    const std::string method = GENERATE("xpbd", "implicit_euler");
    CAPTURE(method);
    Scene scene = test::under({}, method);
    scene.bodies = {cube(0.2, 3, {-0.2, 0, 0}), cube(0.2, 2, {0.1, 0.06, 0.03})};
    scene.bodies[0].velocity = {2, 0, 0};
    scene.gravity = glm::dvec3(0);
    scene.contact.between = true;
    scene.contact.friction = 0.3;
    scene.method.substeps = 20;
    World world(scene, test_device("cpu:serial"));
    const auto [linear, angular] = momenta(world);
    const StepReport before = measure(world);
    CHECK(test::crossed_in(world, 40) == 0);
    const auto [then_linear, then_angular] = momenta(world);
    CHECK(glm::length(then_linear - linear) < 1e-5 * glm::length(linear));
    CHECK(glm::length(then_angular - angular) <
          1e-2 * 0.2 * glm::length(linear)); // sweeps over solids turn them
    const StepReport after = measure(world);
    CHECK(after.kinetic_energy < before.kinetic_energy);
    // The second was at rest: it moves off, and turns about itself, since it was hit off its centre.
    const auto x = world.positions(), v = world.velocities();
    const std::size_t first = world.plan().body_start[1];
    glm::dvec3 centre(0), mean(0), turn(0);
    const double share = 1.0 / static_cast<double>(x.size() - first);
    for (std::size_t i = first; i < x.size(); ++i)
    {
        centre += share * x[i];
        mean += share * v[i];
    }
    for (std::size_t i = first; i < x.size(); ++i)
        turn += share * glm::cross(x[i] - centre, v[i] - mean);
    CHECK(mean.x > 0.3);
    CHECK(glm::length(turn) > 1e-3);
}

TEST_CASE("a solid dropped onto cloth is caught, and never crosses it with the guarantee")
{
    Scene scene;
    Body sheet = test::level_sheet(12, 0.6, {0, 0, 0}, kRadius);
    Pin corners;
    corners.corners = {"top_left", "top_right", "bottom_left", "bottom_right"};
    sheet.pins = {corners};
    sheet.material.stretch_stiffness = 5000;
    Body block = cube(0.12, 2, {0.01, 0.12, 0.02});
    block.material.density = 300;
    scene.bodies = {sheet, block};
    scene.contact.between = true;
    scene.contact.friction = 0.3;
    scene.contact.guarantee = Guarantee::no_crossing;
    scene.method.substeps = 20;
    World caught(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(caught, 90) == 0);
    CHECK(caught.positions().back().y > -0.4); // a fall of 1.5 s would have been 11 m
    CHECK(caught.contacts().pinched == 0);
    scene.bodies[1].velocity = {0, -20, 0};
    World thrown(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(thrown, 30) == 0);
    CHECK(thrown.contacts().filtered > 0);
    scene.contact.guarantee = Guarantee::none;
    World crossing(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(crossing, 30) > 0);
}

TEST_CASE("a bar that is bent onto itself meets itself")
{
    const bool self = GENERATE(true, false);
    Scene scene;
    Body bar = cube(1, 1, {0, 0, 0});
    bar.shape.box_cells = {16, 2, 2};
    bar.shape.box_size = {0.8, 0.08, 0.08};
    bar.contact.self = self;
    Pin fixed, led;
    fixed.faces = {"left"};
    led.faces = {"right"};
    Keyframe start, end;
    end.time = 1;
    // The free end turns over and is led through the middle of the bar.
    end.rotate_axis = {0, 0, 1};
    end.rotate_degrees = 180;
    end.translate = {0.3, -0.2, 0};
    led.motion = {start, end};
    bar.pins = {fixed, led};
    scene.bodies = {bar};
    scene.gravity = glm::dvec3(0);
    scene.method.substeps = 20;
    World world(scene, test_device("cpu:serial"));
    const std::size_t crossed = test::crossed_in(world, 75);
    if (self)
        CHECK(crossed == 0);
    else
        CHECK(crossed > 0);
}

TEST_CASE("solids that hit each other do not go through each other by default")
{
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler");
    CAPTURE(method);
    Scene scene; // one of twice the mass comes from the other side
    scene.bodies = {cube(0.1, 3, {-0.2, 0, 0}, 1e6), cube(0.1, 3, {0.2, 0.02, 0.03}, 1e6)};
    scene.bodies[1].material.density = 2 * kDensity;
    scene.bodies[0].velocity = {2, 0, 0};
    scene.bodies[1].velocity = {-1, 0, 0};
    for (Body& body : scene.bodies)
        body.material.thickness = 0.001;
    scene.gravity = {0, 0, 0};
    scene.contact.between = true;
    scene.method.type = option_named<MethodKind>(method);
    World world(resolve(scene), test_device("cpu:serial"));
    CHECK(test::crossed_in(world, 30) == 0);
    glm::dvec3 momentum[2] = {};
    std::size_t i = 0;
    const auto v = world.velocities();
    for (std::size_t b = 0; b < 2; ++b)
        for (const double mass : vertex_masses(world.scene().bodies[b]))
            momentum[b] += mass * v[i++];
    CHECK(momentum[0].x < -0.5); // kg m/s, 2 before: thrown back by the heavier one
    CHECK(momentum[1].x > 0.5);
}
