// The scenes of examples/contact with solids, each by the criterion that its README names. The judge looks
// at every step.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include "taut/report/scene_budget.hpp"

#include <cmath>

using namespace taut;

TEST_CASE("suite 20: a box slides over the edges of a floor's triangles as over one plane")
{
    JudgedRun run(suite("20_internal_edges"));
    run.run(0.1);
    const glm::dvec3 early = run.centre(1);
    run.run(1);
    CHECK(run.crossed == 0);
    const glm::dvec3 way = run.centre(1) - early;
    CHECK(way.x == Approx(0.9).epsilon(1e-3)); // no friction, 1 m/s
    CHECK(std::abs(way.y) < 1e-4);
    CHECK(std::abs(way.z) < 1e-3);
}

TEST_CASE("suite 20: a box on the edge of a cliff stays while its centre is above the plate")
{
    Scene scene = suite("20_cliff");
    JudgedRun stays(scene);
    const double start = stays.centre(1).y;
    stays.run(1.5);
    CHECK(stays.crossed == 0);
    CHECK(std::abs(stays.centre(1).y - start) < 1e-3);
    scene.bodies[1].transform.translate.x = 0.01;
    JudgedRun falls(scene);
    falls.run(1.5);
    CHECK(falls.crossed == 0);
    CHECK(falls.centre(1).y < start - 0.05);
}

TEST_CASE("suite 22: a block slides on a slope above its cone of friction and stays within it")
{
    const double g = 9.81 / std::sqrt(1.25); // tan of the slope is 0.5
    const auto way = [&](double friction) {
        Scene scene = suite("22_block");
        scene.contact.friction = friction;
        JudgedRun run(scene);
        const double start = run.centre(1).x;
        run.run(1.5);
        CHECK(run.crossed == 0);
        return run.centre(1).x - start;
    };
    CHECK(way(0.4) == Approx(0.5 * g * (0.5 - 0.4) * 2.25).epsilon(0.1));
    CHECK(std::abs(way(0.51)) < 2e-3);
}

TEST_CASE("suite 26: two cards stand with friction above tan 25 / 2, and fall below")
{
    const auto height = [](double friction) {
        Scene scene = suite("26_cards");
        scene.contact.friction = friction;
        JudgedRun run(scene);
        run.run(2);
        CHECK(run.crossed == 0);
        return highest(run.body(1));
    };
    const double tall = highest(JudgedRun(suite("26_cards")).body(1));
    CHECK(height(0.3) > tall - 0.002);
    CHECK(height(0.2) < 0.5 * tall);
}

TEST_CASE("suite 31: rings that are hooked and pulled hold each other")
{
    JudgedRun run(suite("31_hooked_rings"));
    const SceneBudget budget(run.world.scene());
    run.run(2);
    CHECK(run.crossed == 0); // so they are still hooked
    const auto forces = run.world.contact_forces();
    const BodyContactForce* held = force_between(forces, 0, 1);
    REQUIRE(held);
    CHECK(held->force.y < -5);                              // the lower one is led down by 2 cm
    CHECK(judge(budget, run.world).sound()); // what is drawn has been put in
}

TEST_CASE("suite 32: each ring of a chain carries those below it")
{
    JudgedRun run(suite("32_chain"));
    run.run(2);
    CHECK(run.crossed == 0);
    const auto forces = run.world.contact_forces();
    for (std::uint32_t k = 0; k < 4; ++k)
    {
        CAPTURE(k);
        const BodyContactForce* carried = force_between(forces, k, k + 1);
        REQUIRE(carried);
        CHECK(-carried->force.y == Approx(9.81 * (4 - k) * solid_mass(run.world.scene(), 1)).epsilon(0.05));
    }
}

TEST_CASE("suite 37: balls that are squeezed and let go are round again")
{
    JudgedRun run(suite("37_squeezed_balls"));
    const double start = highest(run.body(2));
    run.run(2.4);
    CHECK(highest(run.body(2)) < start - 0.12);
    const auto forces = run.world.contact_forces();
    const BodyContactForce *floor = force_between(forces, 0, 1), *press = force_between(forces, 2, 3);
    REQUIRE(floor);
    REQUIRE(press);
    const double weight = 9.81 * 2 * solid_mass(run.world.scene(), 1);
    CHECK(-floor->force.y + press->force.y == Approx(weight).epsilon(0.1));
    run.run(4);
    CHECK(run.crossed == 0);
    const StepReport report = measure(run.world);
    CHECK(report.volume.inverted == 0);
    CHECK(report.volume.ratio == Approx(1).epsilon(0.01));
    CHECK(highest(run.body(2)) - run.centre(2).y == Approx(0.1).epsilon(0.05));
}

TEST_CASE("suite 55: a cube that carries another one presses with both their weights")
{
    const double density = GENERATE(10.0, 1000.0, 10000.0); // of the upper one; the lower one has 100
    CAPTURE(density);
    Scene scene = suite("55_cubes");
    scene.bodies[2].material.density = density;
    JudgedRun run(scene);
    run.run(1.5);
    CHECK(run.crossed == 0);
    CHECK(run.nearest_parts > 0.95 * 0.004);
    const auto forces = run.world.contact_forces();
    const double upper = 9.81 * solid_mass(run.world.scene(), 2);
    const double both = upper + 9.81 * solid_mass(run.world.scene(), 1);
    REQUIRE(force_between(forces, 0, 1));
    REQUIRE(force_between(forces, 1, 2));
    CHECK(-force_between(forces, 0, 1)->force.y == Approx(both).epsilon(0.05));
    CHECK(-force_between(forces, 1, 2)->force.y == Approx(upper).epsilon(0.05));
}

TEST_CASE("suite 47: cubes lie on each other far from the origin as they do at it, or are refused")
{
    const auto moved = [](double way, const char* precision) {
        Scene scene = suite("55_cubes");
        for (Body& body : scene.bodies)
            body.transform.translate.x += way;
        scene.method.precision = option_named<Precision>(precision);
        return scene;
    };
    const auto lies = [](const Scene& scene) {
        JudgedRun run(scene);
        run.run(1.5);
        CHECK(run.crossed == 0);
        CHECK(run.nearest_parts > 0.95 * 0.004);
        return run.centre(2).y;
    };
    const double here = lies(moved(0, "float"));
    CHECK(std::abs(lies(moved(100, "float")) - here) < 1e-4);
    CHECK(std::abs(lies(moved(1e4, "double")) - here) < 1e-4);
    CHECK_THROWS_WITH(JudgedRun(moved(1e3, "float")), Contains("contact.thickness"));
}

TEST_CASE("suite 56: a bar that is bent until it closes meets itself")
{
    JudgedRun run(suite("56_closing_bar"));
    double push = 0;
    run.run(2.5, [&] {
        for (const BodyContactForce& f : run.world.contact_forces())
            push = std::max(push, f.push);
    });
    CHECK(run.crossed == 0);
    CHECK(push > 1);
    CHECK(measure(run.world).volume.inverted == 0);
}
