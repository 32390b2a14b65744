// What meets what (docs/contact.md): bodies of groups that pass through each other, and how two surfaces rub.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sheets.hpp"

#include "taut/report/report.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/world.hpp"

#include <glm/trigonometric.hpp>

#include <algorithm>

using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius, kNet = 0.03;

/// A sheet above a held net above a held plate.
Scene above_a_net(double height)
{
    Scene scene;
    scene.bodies = {test::level_sheet(6, 0.2, {0, 0, 0}, kRadius),
                    test::level_sheet(6, 0.2, {0.007, kNet, 0.003}, kRadius),
                    test::level_sheet(4, 0.1, {0.011, height, 0.007}, kRadius)};
    test::hold_all(scene.bodies[0]);
    test::hold_all(scene.bodies[1]);
    scene.bodies[1].contact.group = "net";
    scene.bodies[2].contact.group = "sheet";
    scene.contact.between = true;
    scene.method.substeps = 15;
    return scene;
}

double lowest(const World& world, std::size_t body)
{
    double least = 1;
    for (const glm::dvec3& x : world.positions(body))
        least = std::min(least, x.y);
    return least;
}

double mean_way(const World& world, std::size_t body)
{
    double sum = 0;
    const auto places = world.positions(body);
    for (const glm::dvec3& x : places)
        sum += x.x;
    return sum / static_cast<double>(places.size());
}

} // namespace

TEST_CASE("a sheet falls through what it passes, and rests on what it does not", "[contact]")
{
    const std::string guarantee = GENERATE("none", "no_crossing");
    const int who = GENERATE(0, 1, 2); // says it: nobody, the sheet, the net
    CAPTURE(guarantee, who);
    Scene scene = above_a_net(kNet + 0.01);
    scene.contact.guarantee = option_named<Guarantee>(guarantee);
    if (who == 1)
        scene.bodies[2].contact.passes = {"net"};
    if (who == 2)
        scene.bodies[1].contact.passes = {"sheet"};
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 45; ++step)
        world.step();
    const double floor = who == 0 ? kNet : 0;
    CHECK(std::abs(lowest(world, 2) - floor - kGap) < 0.1 * kGap);
    CHECK(measure(world).status == Status::completed);
    const auto forces = world.contact_forces();
    REQUIRE(forces.size() == 1);
    CHECK(forces[0].a == (who == 0 ? 1 : 0));
    CHECK(forces[0].b == 2);
    CHECK(world.contacts().held == 0);
}

TEST_CASE("a start within what is passed is no start that crosses", "[contact]")
{
    Scene scene = above_a_net(kNet);
    scene.bodies[2].transform.rotate_degrees = -80;
    scene.contact.start = ContactStart::refuse;
    CHECK_THROWS_AS(World(scene, test_device("cpu:serial")), Error);
    scene.bodies[2].contact.passes = {"net"};
    CHECK_NOTHROW(World(scene, test_device("cpu:serial")));
    scene.bodies[2].contact.passes = {"default"};
    CHECK_THROWS_AS(World(scene, test_device("cpu:serial")), Error);
}

TEST_CASE("a sheet on a slope rubs by the rule of the scene", "[contact]")
{
    const auto [rule, friction] =
        GENERATE(std::pair("mean", 0.4), std::pair("minimum", 0.2), std::pair("maximum", 0.6),
                 std::pair("product", 0.12), std::pair("geometric_mean", 0.34641)); // tan 20 degrees = 0.36
    CAPTURE(rule);
    Scene scene;
    scene.bodies = {test::level_sheet(8, 0.3, {0, 0, 0}, kRadius),
                    test::level_sheet(3, 0.06, {0, kGap, 0}, kRadius)};
    test::hold_all(scene.bodies[0]);
    scene.bodies[0].contact.friction = 0.2;
    scene.bodies[1].contact.friction = 0.6;
    scene.contact.between = true;
    scene.contact.friction_mix = option_named<FrictionMix>(rule);
    scene.contact.sweeps = 8;
    scene.method.substeps = 15;
    const double slope = glm::radians(20.0);
    scene.gravity = 9.81 * glm::dvec3(std::sin(slope), -std::cos(slope), 0);
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 30; ++step)
        world.step();
    const double time = world.time();
    const double slides = 0.5 * 9.81 * (std::sin(slope) - friction * std::cos(slope)) * time * time;
    if (friction > 0.36)
        CHECK(std::abs(mean_way(world, 1)) < 0.001);
    else
        CHECK(std::abs(mean_way(world, 1) - slides) < 0.05 * slides + 0.001);
}
