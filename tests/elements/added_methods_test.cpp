// Added elements under every method that moves them: answers by hand, the same bits on every executor.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/taut.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace taut;
using namespace taut::elements_test;

namespace {

constexpr double kMass = 0.2, kGravity = 9.81;
const std::vector<std::string> kForceMethods = {"mass_spring", "implicit_euler", "vbd"};

/// Three vertices in a row, 1 m apart, with nothing between them but what a test adds.
Scene three(const std::string& method)
{
    Scene scene;
    scene.timestep = 1.0 / 60;
    scene.gravity = glm::dvec3(0);
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = method == "mass_spring" || method == "pbd" ? 20 : 4;
    if (method == "mass_spring")
        scene.method.stability = StabilityRule::substep;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 2;
    body.material.stretch_stiffness = 0;
    body.vertex_masses = {kMass, kMass, kMass};
    scene.bodies.push_back(body);
    return scene;
}

void hold_first(Scene& scene)
{
    Pin pin;
    pin.corners = {"first"};
    scene.bodies[0].pins.push_back(pin);
}

World run(const Scene& scene, const std::string& selector)
{
    World world(resolve(scene), test_device(selector));
    while (world.time() < scene.duration)
        world.step();
    return world;
}

/// Runs on every executor, which must agree to the last bit; the places where it ends.
std::vector<glm::dvec3> ends(const Scene& scene)
{
    std::vector<glm::dvec3> first;
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        const World world = run(scene, selector);
        const std::vector<glm::dvec3> x = world.positions();
        first = first.empty() ? x : first;
        CHECK(x == first);
    }
    return first;
}

} // namespace

TEST_CASE("a mass hangs from a cubic spring where its weight and the law say, under every method of forces")
{
    add_elements();
    const std::string method = GENERATE(from_range(kForceMethods));
    CAPTURE(method);
    const double compliance = 1e-3, stretch = std::cbrt(2 * kMass * kGravity * compliance / 2);
    Scene scene = three(method);
    hold_first(scene);
    scene.gravity = {0, -kGravity, 0};
    scene.duration = 4;
    scene.damping = 4;
    // The first spring bears both masses; the second, four times as soft a law, one.
    scene.bodies[0].elements.push_back({"cubic_spring", {0, 1, 1, 2}, {1, compliance, 1, 4 * compliance}});
    const std::vector<glm::dvec3> x = ends(scene);
    CHECK(x[1].y == Approx(-1 - stretch).epsilon(1e-3));
    const double second = std::cbrt(kMass * kGravity * 4 * compliance / 2);
    CHECK(x[2].y == Approx(x[1].y - 1 - second).epsilon(1e-3));
}

TEST_CASE("a triangle of a held area comes back to it and its middle stays, under every method of forces")
{
    add_elements();
    const std::string method = GENERATE(from_range(kForceMethods));
    CAPTURE(method);
    Scene scene = three(method);
    scene.damping = 4;
    scene.duration = 4;
    scene.bodies[0].start_positions = {{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}};
    scene.bodies[0].elements.push_back({"held_area", {0, 1, 2}, {0.5, 1e-3}});
    const std::vector<glm::dvec3> x = ends(scene);
    CHECK(glm::length(glm::cross(x[1] - x[0], x[2] - x[0])) / 2 == Approx(0.5).epsilon(1e-3));
    CHECK(glm::distance((x[0] + x[1] + x[2]) / 3.0, glm::dvec3(1, 1.5, 0) / 3.0) < 1e-5);
}

TEST_CASE("a free rod of three masses swings with the period of its energy, under every method of forces")
{
    add_elements();
    const std::string method = GENERATE(from_range(kForceMethods));
    CAPTURE(method);
    // E = k/2 |x0 - 2 x1 + x2|^2: the mode (1, -2, 1) has omega^2 = 6 k / m. A period in 400 substeps.
    const double stiffness = 5, omega = std::sqrt(6 * stiffness / kMass);
    const double period = 2 * std::numbers::pi / omega;
    Scene scene = three(method);
    scene.timestep = period / 20;
    scene.duration = period * 0.999;
    scene.method.precision = Precision::float64;
    scene.method.substeps = 20;
    if (method == "vbd")
        scene.method.iterations = 10;
    const double bow = 0.1; // at the start, as the mode has it
    scene.bodies[0].start_positions = {{-1, bow, 0}, {0, -2 * bow, 0}, {1, bow, 0}};
    scene.bodies[0].elements.push_back({"thin_rod", {0, 1, 2}, {stiffness}});
    Scene quarter = scene; // a quarter on, the rod is straight
    quarter.duration = period * 0.2499;
    const std::vector<glm::dvec3> x = ends(scene);
    CHECK(std::abs(run(quarter, "cpu:serial").positions()[1].y) < 0.1 * bow);
    // Implicit Euler loses a factor of exp(-pi omega h) a period.
    const double left = method == "mass_spring" ? 1 : std::exp(-std::numbers::pi * omega * period / 400);
    CHECK(x[0].y == Approx(bow * left).epsilon(0.03));
    CHECK(x[1].y == Approx(-2 * bow * left).epsilon(0.03));
}

TEST_CASE("pbd holds added elements at rest whatever their compliance")
{
    add_elements();
    Scene scene = three("pbd");
    hold_first(scene);
    scene.gravity = {0, -kGravity, 0};
    scene.duration = 5;
    scene.damping = 4;
    scene.bodies[0].elements.push_back({"cubic_spring", {0, 1, 1, 2}, {1, 1e-3, 1, 1e-3}});
    const std::vector<glm::dvec3> x = ends(scene);
    CHECK(x[1].y == Approx(-1).epsilon(2e-2)); // a cubic constraint halves its stretch in a step
    CHECK(x[2].y == Approx(-2).epsilon(2e-2));
    scene.method.scheme = ElementScheme::node_centric;
    CHECK_THROWS_WITH(make_plan(resolve(scene)), Contains("use \"coloured\""));
}

TEST_CASE("a step that is too long for an added element is refused, or cut, by the element's stiffness")
{
    add_elements();
    Scene scene = three("mass_spring");
    // omega^2 = 6 k / m = 3e6 / s^2; by rows of |K| (4 + 2 + 2) k / m = 4e6, stable below 2 / 2000 s.
    scene.bodies[0].elements.push_back({"thin_rod", {0, 1, 2}, {1e5}});
    scene.bodies[0].start_positions = {{-1, 1e-3, 0}, {0, -2e-3, 0}, {1, 1e-3, 0}};
    scene.method.substeps = 10;
    scene.method.stability = StabilityRule::refuse;
    CHECK_THROWS_WITH(make_plan(resolve(scene)), Contains("the longest stable one"));
    scene.method.stability = StabilityRule::substep;
    const Plan plan = make_plan(resolve(scene));
    const double h = scene.timestep / plan.substeps, bound = 2 / std::sqrt(std::sqrt(3.0) * 4e6);
    CHECK(h < bound); // of a multiple of the identity the Frobenius norm has a root of three
    CHECK(h > 0.8 * bound);
    scene.duration = 2;
    const World world = run(scene, "cpu:serial");
    CHECK(glm::length(world.positions()[1]) < 2.1e-3);
}
