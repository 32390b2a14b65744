// How far surfaces get with the guarantee (docs/contact.md): what keeps them apart must not hold them up.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sheets.hpp"

#include "taut/world/world.hpp"

using namespace taut;

namespace {

/// Without gravity.
Scene guarded(std::vector<Body> bodies)
{
    Scene scene = test::guarded_scene(std::move(bodies));
    scene.gravity = glm::dvec3(0);
    return scene;
}

void set_layer(World& world, std::size_t body, double height, const glm::dvec3& velocity)
{
    std::vector<glm::dvec3> layer = world.scene().bodies[body].mesh.positions;
    for (glm::dvec3& x : layer)
        x.y = height;
    world.set_positions(body, layer);
    world.set_velocities(body, std::vector<glm::dvec3>(layer.size(), velocity));
}

double mean_x(const std::vector<glm::dvec3>& positions)
{
    double sum = 0;
    for (const glm::dvec3& x : positions)
        sum += x.x / static_cast<double>(positions.size());
    return sum;
}

} // namespace

TEST_CASE("surfaces that were kept apart once fall together as if they had not been")
{
    Scene scene = guarded({test::level_sheet(6, 0.12, {0, 0, 0}, 0.001),
                           test::level_sheet(6, 0.12, {0.001, 0.02, 0.002}, 0.001)});
    scene.bodies[1].velocity = {0, -60, 0};
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 2; ++step)
        world.step();
    const std::uint64_t filtered = world.contacts().filtered;
    REQUIRE(filtered > 0);
    const glm::dvec3 fall(2, -8, 0); // 14 mm a substep, over three times as far as the layers are apart
    set_layer(world, 0, 0, fall);
    set_layer(world, 1, 0.004, fall);
    for (int step = 0; step < 5; ++step)
        world.step();
    CHECK(world.contacts().pairs > 100);
    CHECK(world.contacts().filtered == filtered);
}

TEST_CASE("a sheet that strikes another one askew slides on along it")
{
    const double speed = GENERATE(3.0, 30.0, 100.0);
    CAPTURE(speed);
    Scene scene = guarded({test::level_sheet(10, 0.3, {0, 0, 0}, 0.001),
                           test::level_sheet(7, 0.05, {-0.1, 0.01, 0.007}, 0.001)});
    test::hold_all(scene.bodies[0]);
    scene.bodies[1].velocity = {speed, -speed, 0};
    scene.timestep = 0.1 / speed; // of ten substeps, in the first of which it arrives
    World world(scene, test_device("cpu:serial"));
    const double before = mean_x(world.positions(1));
    world.step();
    CHECK(world.contacts().filtered > 0);
    const double way = mean_x(world.positions(1)) - before;
    CHECK(way > 0.05); // of 0.1 without the other one; less if ways are only shortened
    CHECK(way < 0.1);
}
