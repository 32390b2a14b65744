// Energy that the program puts in: runs of it are not called diverged, and would be if it did not count.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/program_moves.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"
#include "taut/report/soundness_watch.hpp"

#include <cmath>

namespace taut {
namespace {

/// A free square of cloth without gravity, 0.2 kg, and a ball in front of it.
Scene target()
{
    Scene scene;
    Body body;
    body.shape.cells = {6, 6};
    scene.bodies = {body};
    Collider ball;
    ball.point = {0, 0, 0.6};
    ball.radius = 0.4;
    scene.colliders = {ball};
    scene.gravity = glm::dvec3(0);
    return resolve(scene);
}

RunState state_of(const World& world, const std::vector<glm::dvec3>& x, const std::vector<glm::dvec3>& v)
{
    return {world.scene(), x, v, world.drive(), Precision::float32, world.events(), 1e9};
}

/// Sound as it is; `diverged` where the world's drive is left out, or where everything is thirty times as
/// fast.
void check_counts(const World& world, const Scene& start)
{
    const EnergyBudget budget(start);
    const std::vector<glm::dvec3> x = world.positions();
    std::vector<glm::dvec3> v = world.velocities();
    RunState state = state_of(world, x, v);
    const Soundness now = judge_motion(budget, state);
    CHECK(now.sound());
    CHECK(now.reason == "");
    CHECK(measure(world).status == Status::completed);
    state.drive.moved.clear();
    state.drive.wind = state.drive.kick = 0;
    CHECK(judge_motion(budget, state).status == Status::diverged);
    for (glm::dvec3& w : v)
        w *= 30.0;
    CHECK(judge_motion(budget, state_of(world, x, v)).status == Status::diverged);
}

} // namespace

TEST_CASE("what a ball that the program moves throws is sound")
{
    const Scene start = target();
    World world(start, test_device("cpu:serial"));
    world.set_collider_velocity(0, {0, 0, -3});
    for (int k = 0; k < 30; ++k)
        world.step();
    check_counts(world, start);
    const std::vector<glm::dvec3> x = world.positions();
    CHECK(x[24].z < -0.5); // it was hit
}

TEST_CASE("what a ball that goes on and off by poses throws is sound")
{
    const Scene start = target();
    World world(start, test_device("cpu:serial"));
    for (int k = 1; k <= 30; ++k)
    {
        world.set_collider_pose(0, {.translate = {0, 0, -0.8 * std::sin(0.2 * k)}});
        world.step();
    }
    check_counts(world, start);
}

TEST_CASE("what a pin that the program shakes draws along is sound")
{
    Scene start = test::hanging(6);
    start.gravity = glm::dvec3(0);
    start.bodies[0].pins[0].moved_by_program = true;
    World world(start, test_device("cpu:serial"));
    for (int k = 1; k <= 40; ++k)
    {
        world.set_pin_pose(0, 0, {.translate = {0, 0, 0.3 * std::sin(0.5 * k)}});
        world.step();
    }
    check_counts(world, start);
}

TEST_CASE("what the wind of the program drives is sound")
{
    Scene start = test::hanging(6);
    start.gravity = glm::dvec3(0);
    start.bodies[0].material.drag = 1;
    start.bodies[0].pins[0].vertices.clear();
    start.wind.density = 1.2;
    World world(start, test_device("cpu:serial"));
    world.set_wind({0, 0, 6});
    for (int k = 0; k < 30; ++k)
        world.step();
    check_counts(world, start);
}

TEST_CASE("velocities that are set count by their energy")
{
    const Scene start = target();
    World world(start, test_device("cpu:serial"));
    world.step();
    world.set_velocities(std::vector(world.plan().vertex_count, glm::dvec3(0, 2, 0)));
    world.step();
    check_counts(world, start);
    CHECK(world.drive().kick == Approx(std::sqrt(0.5 * 0.2 * 4)).epsilon(1e-3));
}

TEST_CASE("energies are not judged after places were set; what is not finite still is")
{
    const Scene start = target();
    World world(start, test_device("cpu:serial"));
    world.set_positions(world.positions());
    world.step();
    const EnergyBudget budget(world.scene());
    const std::vector<glm::dvec3> x = world.positions();
    std::vector<glm::dvec3> v(x.size(), glm::dvec3(0, 100, 0));
    CHECK(judge_motion(budget, state_of(world, x, v)).sound());
    v[0].x = NAN;
    CHECK(judge_motion(budget, state_of(world, x, v)).status == Status::non_finite);
}

TEST_CASE("a watch of a run that the program moves finds nothing")
{
    Scene start = target();
    World world(start, test_device("cpu:serial"));
    SoundnessWatch watch(40);
    for (std::uint64_t k = 1; k <= 40; ++k)
    {
        world.set_collider_pose(0, {.translate = {0, 0, -0.9 * std::sin(0.15 * static_cast<double>(k))}});
        world.step();
        watch.after(k, world);
    }
    CHECK(watch.found().sound());
    CHECK(watch.unconverged() == 0);
}

} // namespace taut
