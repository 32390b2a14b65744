// What is wrong with one body shows whatever else is in the scene: what falls, what touches, what has no
// size.

#include "hard/cases.hpp"

#include "taut/report/residuals.hpp"

namespace taut::hard {
namespace {

StepReport end_of(const Scene& scene)
{
    World world(resolve(scene), test_device("cpu:serial"));
    run(world, 120);
    StepReport out = measure(world);
    judge_residuals(world.scene(), residuals_ahead(world), out); // as `taut run` does
    return out;
}

/// Cloth whose dampers hold it stretched under xpbd: its lower corners hang twice as far as they should.
Scene damped_curtain()
{
    Scene scene = test::hanging(16);
    scene.bodies[0].material.stretch_stiffness = 1e4;
    scene.bodies[0].material.stretch_damping = 0.1;
    scene.bodies[0].material.bending_stiffness = 0;
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0; // 20
    return scene;
}

/// Sixty kilograms of steel that fall four metres, three metres aside.
Body falling_box()
{
    Body box;
    box.shape.kind = ShapeKind::box;
    box.shape.box_cells = {2, 2, 2};
    box.shape.box_size = {0.2, 0.2, 0.2};
    box.material.youngs_modulus = 1e6;
    box.material.density = 7850;
    box.transform.translate = {3, 2.5, 0};
    return box;
}

/// Cloth that vbd leaves level in the air; it should hang by now.
Scene level_cloth(const std::string& method, std::uint32_t substeps)
{
    Scene scene = test::hanging(16);
    scene.bodies[0].transform.rotate_axis = {1, 0, 0};
    scene.bodies[0].transform.rotate_degrees = -90;
    scene.bodies[0].material.stretch_stiffness = 1e4;
    scene.damping = 2;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    return scene;
}

} // namespace

TEST_CASE("what falls beside cloth that blew up hides nothing of it [hard]")
{
    Scene scene = damped_curtain();
    CHECK(end_of(scene).status == Status::diverged);
    scene.bodies.push_back(falling_box());
    const StepReport beside = end_of(scene);
    CHECK(beside.energy_most > 1000); // what the box was given
    CHECK(beside.status == Status::diverged);
    CHECK_THAT(beside.reason, Contains("bodies[0]"));
}

TEST_CASE("dampers do not hold what xpbd left undone [hard]")
{
    Scene scene = damped_curtain();
    Pin& pin = scene.bodies[0].pins[0];
    pin.motion = {{0, {0, 0, 0}}, {1, {0, 0, 0.05}}}; // of all pins: so much energy may have been put in
    Pin other = pin;
    pin.corners = {"top_left"};
    other.corners = {"top_right"};
    other.motion.clear();
    scene.bodies[0].pins.push_back(other);
    const StepReport led = end_of(scene);
    INFO(led.reason << ", " << led.load_way);
    CHECK(led.load_way > 0.01);
    CHECK_FALSE(led.status == Status::completed);
}

TEST_CASE("a ball that touches cloth does not hide that it hangs in the air [hard]")
{
    Collider ball;
    ball.point = {0, -0.02, -0.49};
    ball.radius = 0.02;
    Scene frozen = level_cloth("vbd", 4);
    frozen.colliders = {ball};
    const StepReport left = end_of(frozen);
    CHECK(left.load_residual > 0.25);
    CHECK(left.status == Status::unconverged);
    Scene hangs = level_cloth("implicit_euler", 40);
    hangs.colliders = {ball};
    CHECK(end_of(hangs).status == Status::completed);
}

TEST_CASE("what cannot be judged beside cloth hides nothing of it [hard]")
{
    Body particle, tied = level_cloth("vbd", 4).bodies[0];
    particle.shape.kind = ShapeKind::chain;
    particle.shape.links = 0;
    tied.transform.translate = particle.transform.translate = {5, 1, 0};
    tied.material.attachment_slack = 0.01;
    for (const Body& beside : {particle, tied})
    {
        Scene scene = level_cloth("vbd", 4);
        scene.bodies.push_back(beside);
        const StepReport report = end_of(scene);
        CHECK(report.load_residual > 1);
        CHECK(report.status == Status::unconverged);
    }
}

} // namespace taut::hard
