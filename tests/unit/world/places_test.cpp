// Places and velocities of vertices that the program sets.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/program_moves.hpp"
#include "support/scenes.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

using namespace taut;

namespace {

void run(World& world, int steps)
{
    for (int k = 0; k < steps; ++k)
        world.step();
}

bool same(const WorldState& a, const WorldState& b)
{
    return a.position == b.position && a.low == b.low && a.velocity == b.velocity && a.delta == b.delta &&
           a.kept == b.kept && a.coasting == b.coasting && a.owed == b.owed;
}

/// Two free squares of cloth, 1 m apart, and a ball far below: contacts might act, so that half kicks are
/// taken from what the last substep showed.
Scene two_sheets(const std::string& method = "xpbd")
{
    Scene scene;
    Body body;
    body.shape.cells = {3, 3};
    body.material.stretch_stiffness = 500;
    scene.bodies = {body, body};
    scene.bodies[1].transform.translate = {2, 0, 0};
    Collider ball;
    ball.point = {0, -1000, 0};
    scene.colliders = {ball};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 8;
    return resolve(scene);
}

std::vector<glm::dvec3> shifted(std::vector<glm::dvec3> x, const glm::dvec3& by)
{
    for (glm::dvec3& p : x)
        p += by;
    return x;
}

double largest_distance(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double out = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        out = std::max(out, glm::distance(a[k], b[k]));
    return out;
}

} // namespace

TEST_CASE("what positions() and velocities() gave may be given back and changes nothing")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    World world(test::everything(), test_device(selector));
    run(world, 5);
    const WorldState before = world.state();
    world.set_velocities(world.velocities());
    world.set_velocities(0, world.velocities(0));
    CHECK(same(world.state(), before));
    world.set_positions(world.positions());
    world.set_positions(0, world.positions(0));
    CHECK((world.state().position == before.position));
    CHECK((world.state().low == before.low));
    CHECK(same(world.state(), before));
}

TEST_CASE("a body that is put elsewhere goes on as it would have, on every executor")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    World world(two_sheets(), test_device(selector)), other(two_sheets(), test_device(selector));
    run(world, 3);
    run(other, 3);
    const BodyRange range = world.body_range(1);
    CHECK(range.first == 16);
    CHECK(range.count == 16);
    const glm::dvec3 by(0, 64, 0);
    const std::vector<glm::dvec3> there = shifted(world.positions(1), by);
    world.set_positions(1, there);
    CHECK(largest_distance(world.positions(1), there) < 1e-12);
    for (int k = 0; k < 3; ++k)
    {
        world.step();
        other.step();
        CHECK(world.positions(0) == other.positions(0)); // bit for bit
        CHECK(largest_distance(world.positions(1), shifted(other.positions(1), by)) < 1e-5);
        CHECK(largest_distance(world.velocities(1), other.velocities(1)) < 1e-3);
    }
}

TEST_CASE("places wait for the next step, where the later ones hold, and a restored state has none")
{
    World world(two_sheets(), test_device("cpu:serial")), plain(two_sheets(), test_device("cpu:serial"));
    run(world, 2);
    run(plain, 2);
    const WorldState kept = world.state();
    const std::vector<glm::dvec3> there = shifted(world.positions(), {0, 1, 0});
    world.set_positions(shifted(there, {5, 0, 0}));
    world.restore(kept);
    run(world, 1);
    run(plain, 1);
    CHECK(same(world.state(), plain.state()));
    world.set_positions(shifted(there, {5, 0, 0}));
    world.set_positions(0, world.positions(0));
    plain.set_positions(1, shifted({there.begin() + 16, there.end()}, {5, 0, 0}));
    plain.set_positions(0, shifted({there.begin(), there.begin() + 16}, {5, 0, 0}));
    run(world, 2);
    run(plain, 2);
    CHECK(same(world.state(), plain.state()));
    CHECK(world.drive().placed == 2); // of those before restore() nothing is left
}

TEST_CASE("velocities that are set are those at the step, and lead to the parabola, under every method")
{
    const auto method = GENERATE(from_range(kWords<MethodKind>));
    CAPTURE(method);
    World world(two_sheets(std::string(method)), test_device("cpu:serial"));
    run(world, 4);
    const glm::dvec3 v(1, 6, -2), g = world.scene().gravity;
    const std::vector<glm::dvec3> start = world.positions(1), others = world.velocities(0);
    world.set_velocities(1, std::vector(16, v));
    CHECK(largest_distance(world.velocities(1), std::vector(16, v)) < 1e-5);
    CHECK(world.velocities(0) == others);
    run(world, 6);
    const double t = 6 * world.scene().timestep;
    CHECK(largest_distance(world.positions(1), shifted(start, v * t + 0.5 * g * t * t)) < 2e-5);
}

TEST_CASE("velocities of held vertices are not read; their places are")
{
    World world(test::hanging(4), test_device("cpu:serial"));
    run(world, 2);
    const std::vector<std::uint32_t> held = world.scene().bodies[0].pins[0].vertices;
    REQUIRE(held.size() == 2);
    world.set_velocities(shifted(world.velocities(), {0, 1, 0}));
    CHECK(world.velocities()[held[0]] == glm::dvec3(0));
    const std::vector<glm::dvec3> there = shifted(world.positions(), {0, 0.25, 0});
    world.set_positions(there);
    run(world, 3);
    for (const std::uint32_t v : held)
        CHECK(glm::distance(world.positions()[v], there[v]) < 1e-7);
}

TEST_CASE("wrong places and velocities are refused, and change nothing")
{
    World world(two_sheets(), test_device("cpu:serial"));
    run(world, 2);
    const WorldState before = world.state();
    std::vector<glm::dvec3> x = world.positions();
    x[7].z = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(world.set_positions(x),
                      Contains("set_positions: what is given for vertex 7 is not finite"));
    CHECK_THROWS_WITH(world.set_velocities(x), Contains("set_velocities: what is given for vertex 7"));
    x[7].z = 1e13;
    CHECK_THROWS_WITH(world.set_positions(x), Contains("vertex 7"));
    CHECK_THROWS_WITH(world.set_positions(0, x), Contains("32 positions for 16 vertices"));
    CHECK_THROWS_WITH(world.set_velocities(std::span(x).first(3)), Contains("3 velocities for 32 vertices"));
    CHECK_THROWS_WITH(world.set_positions(2, x), Contains("body 2 of 2"));
    CHECK_THROWS_WITH(world.positions(2), Contains("body 2 of 2"));
    CHECK_THROWS_AS(world.body_range(2), Error);
    CHECK(same(world.state(), before));
    CHECK(world.drive().placed == 0);
}
