// Surfaces that lie on each other for long stay where they are, whatever else is searched for
// (docs/contact.md).

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"

#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

using namespace taut;

namespace {

constexpr double kRadius = 0.002;
constexpr int kLayers = 4;

/// Layers on a plate, each a little beside the one below it.
Scene layers()
{
    Scene scene;
    scene.bodies = {test::level_sheet(6, 0.3, {0, 0, 0}, kRadius)};
    scene.bodies[0].kinematic.used = true;
    for (int k = 1; k <= kLayers; ++k)
    {
        const glm::dvec3 beside(0.003 * (k % 3), 2.001 * kRadius * k, 0.002 * (k % 2));
        scene.bodies.push_back(test::level_sheet(5, 0.15, beside, kRadius));
        scene.bodies.back().material.density = 0.2;
        scene.bodies.back().material.bending_stiffness = 1e-4;
    }
    scene.contact.between = true;
    scene.contact.friction = 0.3;
    scene.method.substeps = 20;
    return scene;
}

/// m: how far any vertex of the layers goes in so many steps.
double way(World& world, int steps)
{
    const auto before = world.positions();
    for (int step = 0; step < steps; ++step)
        world.step();
    const auto after = world.positions();
    double out = 0;
    for (std::size_t v = world.plan().body_start[1]; v < world.plan().body_start[1 + kLayers]; ++v)
        out = std::max(out, glm::distance(before[v], after[v]));
    return out;
}

} // namespace

TEST_CASE("suite 60: layers at rest do not creep, with few sweeps, beside a flag too")
{
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler");
    const bool flag = GENERATE(false, true);
    CAPTURE(method, flag);
    Scene scene = layers();
    if (flag) // what flies calls for searches, which number all pairs anew
    {
        Body flies = test::level_sheet(5, 0.2, {0.6, 0.2, 0}, kRadius);
        flies.transform.rotate_degrees = 0;
        Pin top;
        top.edges = {"top"};
        flies.pins = {top};
        flies.velocity = {0, 0, 2};
        scene.bodies.push_back(flies);
    }
    World world(test::under(scene, method), test_device("cpu:serial"));
    way(world, 120);
    CHECK(way(world, 300) < 2e-6);
    CHECK((!flag || world.contacts().searches > 300));
}

TEST_CASE("layers that are pushed aside slide, and stay where that leaves them")
{
    World world(layers(), test_device("cpu:serial"));
    way(world, 60);
    auto places = world.positions();
    const std::size_t first = world.plan().body_start[4];
    std::vector<glm::dvec3> top(places.begin() + static_cast<std::ptrdiff_t>(first), places.end());
    for (glm::dvec3& x : top)
        x.x += 0.02;
    world.set_positions(4, top);
    way(world, 300);
    places = world.positions();
    double aside = 0;
    for (std::size_t v = 0; v < top.size(); ++v)
        aside = std::max(aside, std::abs(places[first + v].x - top[v].x));
    CHECK(aside < 1e-4); // friction does not draw them back
    CHECK(way(world, 120) < 2e-6);
}
