// The scenes of examples/contact with cloth on what is led, each by the criterion that its README names.
// The judge, which shares nothing with the kernels, looks at every step.

#include "support/catch.hpp"
#include "support/judged_run.hpp"
#include "support/methods.hpp"

#include "taut/runtime/base/error.hpp"

#include <glm/gtc/constants.hpp>

#include <cmath>

using namespace taut;

TEST_CASE("suite 04: a sheet lies a gap above a plate and does not drift")
{
    JudgedRun run(suite("04_sheet_on_plate"));
    run.run(1);
    const glm::dvec3 settled = run.centre(1);
    run.run(2.5);
    CHECK(run.crossed == 0);
    CHECK(glm::distance(run.centre(1), settled) < 1e-4);
    for (const glm::dvec3& x : run.body(1))
        CHECK(std::abs(x.y - 0.004) < 0.05 * 0.004);
    const auto forces = run.world.contact_forces();
    const BodyContactForce* carried = force_between(forces, 0, 1);
    REQUIRE(carried);
    const double weight = 9.81 * sheet_mass(run.world.scene(), 1);
    CHECK(-carried->force.y == Approx(weight).epsilon(0.01));
    CHECK(carried->push == Approx(weight).epsilon(0.01)); // all of it straight up
}

TEST_CASE("suite 05: the lowest layer of a stack is pressed by all others")
{
    JudgedRun run(suite("05_stack"));
    run.run(0.6);
    CHECK(run.crossed == 0);
    const auto forces = run.world.contact_forces();
    for (std::uint32_t k = 0; k < 8; ++k) // between layers k and k + 1; 0 is the plate
    {
        CAPTURE(k);
        CHECK(run.centre(k + 1).y > run.centre(k).y + 0.9 * 0.004);
        const BodyContactForce* carried = force_between(forces, k, k + 1);
        REQUIRE(carried);
        CHECK(-carried->force.y == Approx(9.81 * (8 - k) * sheet_mass(run.world.scene(), 1)).epsilon(0.05));
    }
}

TEST_CASE("suite 06: sheets that collide in free space keep their momentum and gain no energy")
{
    // A substep may not take them further than the gap: no filter forbids crossings.
    const auto [speed, substeps] = GENERATE(std::pair(1.0, 20u), std::pair(10.0, 80u));
    CAPTURE(speed, substeps);
    Scene scene = suite("06_collision");
    scene.method.substeps = substeps;
    scene.bodies[0].velocity.y = -speed / 2;
    scene.bodies[1].velocity.y = speed / 2;
    JudgedRun run(scene);
    const double before = measure(run.world).kinetic_energy;
    run.run(0.04 / speed + 0.1);
    const StepReport after = measure(run.world);
    CHECK(run.crossed == 0);
    CHECK(after.momentum_error >= 0);
    CHECK(after.momentum_error < 1e-6);
    CHECK(after.kinetic_energy < before);
}

TEST_CASE("suite 10: a cloth is pulled through a ring, and what crosses on the way is said")
{
    JudgedRun run(suite("10_through_a_ring"));
    run.run(1.8);
    CHECK(highest(run.body(1)) < -0.1);
    CHECK(run.nearest_parts > 0.5 * 0.008); // it crosses itself, but not the ring
    CHECK(measure(run.world).status == Status::completed);
}

TEST_CASE("suite 22: a sheet slides on a slope above its cone of friction and stays within it")
{
    const double g = 9.81 / std::sqrt(1.25); // tan of the slope is 0.5
    const auto way = [&](double friction) {
        Scene scene = suite("22_slope");
        scene.contact.friction = friction;
        JudgedRun run(scene);
        run.run(2);
        CHECK(run.crossed == 0);
        return run.centre(1).x;
    };
    CHECK(way(0.49) == Approx(0.5 * g * (0.5 - 0.49) * 4).epsilon(0.1));
    CHECK(std::abs(way(0.51)) < 2e-5);
}

TEST_CASE("suite 23: a sheet slides as far as friction lets it")
{
    const double friction = GENERATE(0.5, 1.0);
    Scene scene = suite("23_slide");
    scene.contact.friction = friction;
    JudgedRun run(scene);
    run.run(2.5);
    CHECK(run.crossed == 0);
    CHECK(run.centre(1).x == Approx(100 / (2 * friction * 9.81)).epsilon(0.05));
}

TEST_CASE("suite 24: a ribbon over a cylinder holds below the capstan equation's ratio and slips above")
{
    // exp(0.3 pi) = 2.566 of the forces at the two ends of the half turn.
    const auto fall = [](double heavy) {
        Scene scene = suite("24_capstan");
        auto& m = scene.bodies[1].vertex_masses;
        m[m.size() - 1] = m[m.size() - 2] = heavy;
        JudgedRun run(scene);
        run.run(0.5);
        const double before = run.body(1).back().y;
        run.run(1);
        CHECK(run.crossed == 0);
        return before - run.body(1).back().y;
    };
    CHECK(fall(0.045) < 1e-4);
    CHECK(fall(0.06) > 0.01);
}

TEST_CASE("suite 30: cloth on a sphere that turns goes round with it")
{
    JudgedRun run(suite("30_turning_sphere"));
    run.run(1.5);
    double turned = 0;
    std::vector<glm::dvec3> last = run.body(1);
    const auto angle = [](const glm::dvec3& x) { return std::atan2(-x.z, x.x); };
    std::size_t near = 0; // a vertex that lies on the sphere, off its pole
    for (std::size_t v = 0; v < last.size(); ++v)
        if (std::abs(std::hypot(last[v].x, last[v].z) - 0.12) <
            std::abs(std::hypot(last[near].x, last[near].z) - 0.12))
            near = v;
    run.run(2, [&] { last = run.body(1); }); // until it goes round as the sphere does
    run.run(4, [&] {
        const auto now = run.body(1);
        turned += std::remainder(angle(now[near]) - angle(last[near]), glm::two_pi<double>());
        last = now;
    });
    CHECK(run.crossed == 0);
    CHECK(turned == Approx(glm::two_pi<double>()).epsilon(0.05)); // 360 degrees in two seconds
}

TEST_CASE("suite 52: a ball that hits a curtain is not passed through")
{
    const double speed = GENERATE(1.0, 10.0);
    CAPTURE(speed);
    Scene scene = suite("52_hit");
    scene.bodies[0].kinematic.motion = {{0.1}, {0.1 + 0.5 / speed, {0, 0, 0.5}}};
    JudgedRun run(scene);
    run.run(0.1 + 0.5 / speed);
    CHECK(run.crossed == 0);
    double front = -1;
    for (const glm::dvec3& x : run.body(1))
        front = std::max(front, x.z);
    CHECK(front > 0.34); // the ball's front is at 0.35
}

TEST_CASE("suite 52: with the guarantee a ball may hit a curtain as fast as it likes")
{
    const double speed = GENERATE(1.0, 10.0, 50.0);
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler");
    CAPTURE(speed, method);
    Scene scene = test::under(suite("52_hit"), method);
    scene.contact.guarantee = Guarantee::no_crossing;
    scene.bodies[0].kinematic.motion = {{0.1}, {0.1 + 0.5 / speed, {0, 0, 0.5}}};
    JudgedRun run(scene);
    double front = -1;
    run.run(0.1 + 0.5 / speed + 0.1, [&] {
        for (const glm::dvec3& x : run.body(1))
            front = std::max(front, x.z);
    });
    CHECK(run.intersected == 0);
    CHECK(run.world.contacts().pinched == 0);
    CHECK(front > 0.34); // where the ball's front stops is 0.35
}

TEST_CASE("suite 54: the corner of a box lifts a sheet whose edges are longer than the box")
{
    JudgedRun run(suite("54_corner"));
    run.run(2);
    CHECK(run.crossed == 0);
    double corner = -1, sheet = 1;
    for (const glm::dvec3& x : run.body(0))
        corner = std::max(corner, x.y);
    for (const glm::dvec3& x : run.body(1))
        sheet = std::min(sheet, x.y);
    CHECK(corner > 0.22); // it rose above where the sheet hung
    CHECK(sheet < corner);
}

TEST_CASE("surfaces that start within each other are named, or refused where the scene asks for that")
{
    Scene scene = suite("06_collision");
    scene.bodies[0].name = "first";
    scene.bodies[1].transform.translate.y = 0.02;
    scene.bodies[1].transform.rotate_degrees = -80;
    CHECK_NOTHROW(World(scene, test_device("cpu:serial")));
    scene.contact.start = ContactStart::refuse;
    CHECK_THROWS_WITH(World(scene, test_device("cpu:serial")),
                      Contains("go through each other at the start") &&
                          Contains("of bodies[0] (\"first\") and"));
    scene.bodies[1].transform.translate.y = -0.02;
    CHECK_NOTHROW(World(scene, test_device("cpu:serial")));
    scene.contact.between = false; // then they may
    scene.bodies[1].transform.translate.y = 0.02;
    CHECK_NOTHROW(World(scene, test_device("cpu:serial")));
}
