// A strip of cloth that falls on itself (docs/contact.md): where it is searched often enough, and where it is
// kept from crossing.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sheets.hpp"

#include "taut/world/world.hpp"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius;

/// A strip of which half lies, held; the other is folded back above it, upright at the fold, and falls.
Scene strip_on_itself()
{
    Scene scene;
    Body strip;
    strip.material.stretch_stiffness = 1000;
    strip.material.thickness = kRadius;
    strip.transform.rotate_axis = {1, 0, 0};
    strip.transform.rotate_degrees = -90; // it lies level
    strip.shape.cells = {40, 5};
    strip.shape.size = {0.4, 0.05};
    strip.material.bending_stiffness = 1e-6;
    strip.contact.self = true;
    scene.bodies = {strip};
    const Mesh mesh = resolve(scene).bodies[0].mesh;
    for (const glm::dvec3& x : mesh.positions)
    {
        const double past = std::max(0.0, x.x), bend = std::min(past, 0.03);
        const double turn = bend / 0.03 * glm::radians(180.0), r = 0.03 / glm::radians(180.0);
        strip.start_positions.push_back({std::min(x.x, 0.0) + r * std::sin(turn) - std::max(0.0, past - 0.03),
                                         r * (1 - std::cos(turn)), x.z});
    }
    Pin pin;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        if (mesh.positions[v].x < 1e-3)
            pin.vertices.push_back(v);
    strip.pins = {pin};
    scene.bodies = {strip};
    scene.contact.friction = 1; // else the fold pulls the rest over the edge of what is held
    scene.contact.between = false;
    scene.method.substeps = 20;
    return scene;
}

std::size_t crossed_in(const Scene& scene, int steps)
{
    World world(scene, test_device("cpu:serial"));
    return test::crossed_in(world, steps);
}

} // namespace

TEST_CASE("a strip that falls on itself does not cross itself, however far its searches look ahead")
{
    Scene scene = strip_on_itself();
    scene.bodies[0].contact.self = true;
    scene.contact.searches = GENERATE(1u, 2u, 5u, 20u);
    scene.contact.guarantee = GENERATE(Guarantee::none, Guarantee::no_crossing);
    CAPTURE(scene.contact.searches, scene.contact.guarantee);
    CHECK(crossed_in(scene, 90) == 0);
}

TEST_CASE("a strip that falls on itself lies above itself, without a triangle in another")
{
    Scene scene = strip_on_itself();
    const bool meets = GENERATE(true, false);
    scene.bodies[0].contact.self = meets;
    World world(scene, test_device("cpu:serial"));
    const auto triangles = test::all_triangles(world.scene());
    REQUIRE(test::intersections(triangles, world.positions()) == 0);
    std::size_t crossed = 0;
    for (int step = 0; step < 90; ++step)
    {
        world.step();
        crossed += test::intersections(triangles, world.positions());
    }
    if (meets)
        CHECK(crossed == 0);
    else
        CHECK(crossed > 0); // it would hang through itself
    if (meets)
        CHECK(std::abs(world.positions()[30].y - kGap) < 0.1 * kGap); // above what is held
}
