// Claims about triangles that meet several colliders, beside bodies that do not: each pair as if it were
// alone.

#include "hard/cases.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"
#include "support/tilted_block.hpp"

#include "taut/scene/faces.hpp"
#include "taut/world/hybrid.hpp"
#include "taut/world/sleep.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::hard;

namespace {

Collider ball(const glm::dvec3& middle, double radius)
{
    Collider out;
    out.kind = ColliderKind::sphere;
    out.point = middle;
    out.radius = radius;
    out.friction = 0.3;
    return out;
}

/// A fine sheet on a small ball and on one that its vertices are close enough together for, and 4 m beside it
/// a coarse one that meets balls of that size by its triangles, too.
Scene two_sheets()
{
    Scene scene;
    scene.bodies = {test::level_sheet(12, 1, {0, 0.33, 0}, 0.005),
                    test::level_sheet(3, 1, {4, 0.33, 0}, 0.005)};
    scene.colliders = {ball({-0.3, 0.28, 0.02}, 0.02), ball({0.2, 0, 0}, 0.3), ball({4, 0, 0}, 0.3)};
    scene.damping = 1;
    return resolve(scene);
}

Scene without_coarse(Scene scene)
{
    scene.bodies.pop_back();
    return scene;
}

std::vector<glm::dvec3> first_of(const std::vector<glm::dvec3>& x, std::size_t count)
{
    return {x.begin(), x.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// A block on two posts, one beside the other along z. Of one cell, each of its triangles lies on both.
Scene block_on_posts(double degrees, double first, double second, std::uint32_t cells)
{
    const glm::dvec3 half(0.1, 0.1, 0.06);
    Scene scene;
    scene.bodies = {test::tilted_block(degrees, cells)};
    scene.colliders = {test::tilted_post(degrees, {0, 0, -0.15}, half, first),
                       test::tilted_post(degrees, {0, 0, 0.15}, half, second)};
    return scene;
}

/// m/s^2, down the slope, once the block has landed and come to lie.
double slide_of(const Scene& scene)
{
    World world(scene, test_device("cpu:serial"));
    run(world, 9);
    const double early = glm::length(test::mean_velocity(world));
    run(world, 9);
    return (glm::length(test::mean_velocity(world)) - early) * 60 / 9;
}

} // namespace

TEST_CASE("a body meets balls by triangles or not as it does alone, whatever meets them beside it", "[face]")
{
    const Scene scene = two_sheets();
    REQUIRE(meets_surface(scene.bodies[0], scene.colliders[0]));
    REQUIRE(!meets_surface(scene.bodies[0], scene.colliders[1]));
    REQUIRE(meets_surface(scene.bodies[1], scene.colliders[1]));
    // Not those whose solves have sums over all bodies.
    const std::string method = GENERATE("xpbd", "vbd", "mass_spring", "acad", "pbd");
    CAPTURE(method);
    World both(test::under(scene, method), test_device("cpu:serial"));
    World alone(test::under(without_coarse(scene), method), test_device("cpu:serial"));
    run(both, 40);
    run(alone, 40);
    const std::size_t count = scene.bodies[0].mesh.positions.size();
    CHECK(first_of(both.positions(), count) == alone.positions());
}

TEST_CASE("worlds that sleep and hybrid ones meet colliders by triangles as one world does", "[face]")
{
    const Scene scene = two_sheets();
    World one(scene, test_device("cpu:serial"));
    SleepWorld sleep(scene, test_device("cpu:serial"));
    HybridWorld hybrid(scene, Device::open("cpu:serial"), Device::open("cpu"));
    for (int step = 0; step < 40; ++step)
    {
        one.step();
        sleep.step();
        hybrid.step();
    }
    CHECK(sleep.positions() == one.positions());
    CHECK(hybrid.positions() == one.positions());
}

TEST_CASE("a block on a rough and a smooth post is held back by the rough one alone", "[face]")
{
    const double first = GENERATE(0.0, 0.1, 0.3), second = GENERATE(0.0, 0.3);
    CAPTURE(first, second);
    const double tilt = glm::radians(20.0), mean = 0.5 * (first + second);
    const double expected = 9.81 * (std::sin(tilt) - mean * std::cos(tilt));
    CHECK(slide_of(block_on_posts(20, first, second, 1)) == Approx(expected).epsilon(0.05));
}

TEST_CASE("friction of triangles does not depend on how many iterations and substeps there are", "[face]")
{
    const std::uint32_t iterations = GENERATE(1u, 4u, 20u), substeps = GENERATE(1u, 20u);
    const std::string method = GENERATE("pbd", "xpbd");
    CAPTURE(method, iterations, substeps);
    const auto slide = [&](double friction) {
        Scene scene = test::under(block_on_posts(20, friction, friction, 3), method);
        if (method == "pbd")
            scene.bodies[0].material.model = SolidModel::springs;
        scene.method.iterations = iterations;
        scene.method.substeps = substeps;
        return slide_of(scene);
    };
    // A block that is not quite solved goes on settling, with friction as without.
    CHECK(slide(0) - slide(0.2) == Approx(0.2 * 9.81 * std::cos(glm::radians(20.0))).epsilon(0.04));
}

TEST_CASE("cloth that falls onto narrow colliders does not come back", "[face]")
{
    const double speed = GENERATE(1.0, 3.0);
    const auto method = GENERATE(from_range(kWords<MethodKind>));
    const std::uint32_t cells = GENERATE(2u, 5u);
    for (const double radius : {0.02, 0.1})
    {
        CAPTURE(speed, method, cells, radius);
        Scene scene;
        scene.bodies = {test::level_sheet(cells, 0.5, {0.03, 0.11, 0.02}, 0.005)};
        scene.bodies[0].velocity = {0, -speed, 0};
        scene.colliders = {ball({0, 0, 0}, radius)};
        scene.gravity = {0, 0, 0};
        World world(test::under(scene, std::string(method)), test_device("cpu:serial"));
        double back = -speed;
        for (int step = 0; step < 30; ++step)
        {
            world.step();
            back = std::max(back, test::mean_velocity(world).y);
        }
        // Its springs give back 0.21, and as much where the vertices of fine cloth meet the ball.
        CHECK(back < 0.25 * speed);
        CHECK(back > -0.5 * speed); // nor does it fall on
    }
}
