// The scenes of examples/contact in which friction draws something along, each by the criterion that its
// README names.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include <cmath>

using namespace taut;

namespace {

double lowest(const std::vector<glm::dvec3>& places)
{
    double out = 1e300;
    for (const glm::dvec3& x : places)
        out = std::min(out, x.y);
    return out;
}

/// m: how far a dish goes whose cloth is drawn away by 1 m at so many m/s.
double way_of_dish(double speed)
{
    CAPTURE(speed);
    Scene scene = suite("29_tablecloth");
    scene.bodies[1].pins[0].motion[1].time = scene.bodies[1].pins[0].motion[0].time + 1 / speed;
    JudgedRun run(scene);
    run.run(scene.bodies[1].pins[0].motion[0].time);
    const glm::dvec3 start = run.centre(2);
    run.run(scene.bodies[1].pins[0].motion[1].time);
    CHECK(run.crossed == 0); // then the cloth, stopped within a step, flies on and over itself
    run.run(scene.bodies[1].pins[0].motion[1].time + 0.4);
    CHECK(run.centre(1).x > 0.6); // the cloth has gone
    CHECK(std::abs(run.centre(2).z - start.z) < 0.005);
    return run.centre(2).x - start.x;
}

/// Of the ball, after a second.
double lowest_of_ball(const Scene& scene)
{
    JudgedRun run(scene);
    run.run(1);
    CHECK(run.crossed == 0);
    const StepReport report = measure(run.world);
    CHECK(report.volume.inverted == 0);
    CHECK(report.volume.ratio == Approx(1).epsilon(0.02));
    return lowest(run.body(2));
}

} // namespace

TEST_CASE("suite 29: the faster a tablecloth is drawn away, the less its dish goes along")
{
    const double slow = way_of_dish(1), fast = way_of_dish(2), faster = way_of_dish(4);
    CHECK(slow > 2 * fast);
    CHECK(fast > 2 * faster);
    // While it is on the cloth the dish gets friction times g, and loses it on the table.
    const double off = 0.19; // m: the end of the cloth to the far side of the dish
    CHECK(fast < 0.3 * 9.81 * std::pow(off / 2, 2));
    CHECK(fast > 0.5 * 0.3 * 9.81 * std::pow(off / 2, 2));
}

TEST_CASE("suite 29: a cloth that is drawn slowly takes its dish along") { CHECK(way_of_dish(0.5) > 0.9); }

TEST_CASE("suite 35: rollers draw a soft ball through a gap of half its width")
{
    const Scene turning = resolve(suite("35_rollers"));
    Scene still = turning, smooth = turning;
    for (const std::size_t roller : {0, 1})
        still.bodies[roller].pins[0].motion.clear();
    smooth.contact.friction = 0;
    CHECK(lowest_of_ball(turning) < -0.3);
    CHECK(lowest_of_ball(still) > 0);
    CHECK(lowest_of_ball(smooth) > 0);
}

TEST_CASE("suite 33: a cloth is pushed through a funnel and crosses nothing")
{
    JudgedRun run(suite("33_funnel"));
    run.run(0.5);
    CHECK(lowest(run.body(1)) > -0.15); // the funnel holds what the ball has not pushed down yet
    run.run(1.1);
    CHECK(highest(run.body(1)) < -0.21);
    CHECK(run.intersected == 0);
    CHECK(run.world.contacts().pinched == 0);
}
