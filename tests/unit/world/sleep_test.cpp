#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/world/sleep.hpp"

#include <algorithm>

using namespace taut;

namespace {

/// Soft blocks that lie on a plane, 2 m apart.
Scene blocks(int count)
{
    Scene scene;
    for (int k = 0; k < count; ++k)
    {
        Body body;
        body.shape.kind = ShapeKind::box;
        body.shape.box_cells = {2, 2, 2};
        body.material = solid_material();
        body.transform.translate = {2.0 * k, 0.502, 0};
        scene.bodies.push_back(body);
    }
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.friction = 0.5;
    scene.colliders = {floor};
    scene.damping = 3;
    scene.external_forces = true;
    return resolve(scene);
}

void run(SleepWorld& world, int steps)
{
    for (int k = 0; k < steps; ++k)
        world.step();
}

std::vector<glm::dvec3> of_body(const std::vector<glm::dvec3>& x, std::size_t body, std::size_t each)
{
    return {x.begin() + static_cast<std::ptrdiff_t>(body * each),
            x.begin() + static_cast<std::ptrdiff_t>((body + 1) * each)};
}

} // namespace

TEST_CASE("bodies at rest sleep, cost nothing, and time goes on")
{
    SleepWorld world(blocks(3), test_device("cpu:serial"));
    run(world, 400);
    CHECK(world.asleep() == 3);
    CHECK(world.awake().plan().passes.empty());
    const auto before = world.positions();
    run(world, 100);
    CHECK(world.positions() == before);
    CHECK(world.time() == Approx(500.0 / 60).epsilon(1e-9));
    CHECK(world.steps() == 500);
}

TEST_CASE("bodies that do not sleep move bit for bit as beside the sleeping ones")
{
    Scene scene = blocks(3);
    scene.bodies[1].velocity = {0, 20, 0}; // in the air while the others fall asleep
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        SleepWorld world(scene, test_device(selector));
        World whole(scene, test_device(selector));
        const int steps = selector.starts_with("cpu") ? 230 : 45;
        bool slept = false;
        for (int k = 0; k < steps; ++k)
        {
            world.step();
            whole.step();
            slept = slept || world.asleep() > 0;
        }
        const std::size_t each = scene.bodies[0].mesh.positions.size();
        CHECK(of_body(world.positions(), 1, each) == of_body(whole.positions(), 1, each));
        if (selector == "cpu:serial")
            CHECK(slept);
    }
}

TEST_CASE("a sleeping body wakes for a force, a pin or a collider, and goes on from where it fell asleep")
{
    Scene scene = blocks(2);
    scene.bodies[1].pins = {Pin{}};
    scene.bodies[1].pins[0].vertices = {26};
    const double late = 12;
    scene.bodies[1].pins[0].motion = {{late, {0, 0, 0}}, {late + 1, {0, 0.2, 0}}};
    Collider ball;
    ball.point = {0, 1.25, 8};
    ball.radius = 0.3;
    ball.motion = {{late + 4, {0, 0, 0}}, {late + 6, {0, 0, -8}}};
    scene.colliders.push_back(ball);
    SleepWorld world(scene, test_device("cpu:serial"));
    run(world, 600);
    REQUIRE(world.asleep() == 2);
    const auto rest = world.positions();

    world.set_force(0, {0, 0, 0}); // wakes, and changes nothing
    CHECK(world.asleep() == 1);
    CHECK(world.positions() == rest);
    run(world, 60);
    CHECK(world.asleep() == 2); // asleep again

    run(world, 720 - 660 + 3); // the pin begins at 12 s
    CHECK_FALSE(world.asleep(1));
    CHECK(world.asleep(0));
    run(world, 200);
    while (world.time() < late + 4)
        world.step();
    CHECK(world.asleep(0));
    bool woken = false; // the ball grazes the first
    while (world.time() < late + 6)
    {
        world.step();
        woken = woken || !world.asleep(0);
    }
    CHECK(woken);
    CHECK(world.changes() >= 5);
}

TEST_CASE("a world that sleeps gives its state to a whole one, and refuses methods with a memory")
{
    const Scene scene = blocks(2);
    SleepWorld world(scene, test_device("cpu:serial"));
    run(world, 400);
    World whole(scene, test_device("cpu:serial"));
    world.copy_into(whole);
    CHECK(whole.positions() == world.positions());
    CHECK(whole.steps() == 400);
    Scene other = scene;
    other.method.type = MethodKind::vbd;
    for (Body& body : other.bodies)
    {
        body.material.model = SolidModel::springs;
        body.material.volume_stiffness = 0;
    }
    CHECK_THROWS_WITH(SleepWorld(other, test_device("cpu:serial")), Contains("cannot sleep"));
    Scene linear = scene;
    linear.method.type = MethodKind::implicit_euler;
    CHECK_THROWS_WITH(SleepWorld(linear, test_device("cpu:serial")), Contains("as one system"));
}

TEST_CASE("the others keep the substeps of the stiffest body when it sleeps")
{
    Scene scene = blocks(2);
    scene.method.type = MethodKind::mass_spring;
    scene.method.stability = StabilityRule::substep;
    for (Body& body : scene.bodies)
    {
        body.material.model = SolidModel::springs;
        body.material.volume_stiffness = 0;
    }
    scene.bodies[0].material.youngs_modulus = 4e6;
    scene.bodies[1].velocity = {0, 20, 0};
    SleepWorld world(scene, test_device("cpu:serial"));
    const std::uint32_t substeps = world.awake().plan().substeps;
    for (int k = 0; k < 230 && world.asleep() == 0; ++k)
        world.step();
    REQUIRE(world.asleep(0));
    CHECK(world.awake().plan().substeps == substeps);
}
