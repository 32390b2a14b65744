// The scenes of examples/contact in which surfaces are pinched, twisted, pierced and piled up, each by the
// criterion that its README names. The judge looks at every step. With the guarantee ways within a step are
// not straight, so there only where steps end counts.

#include "support/catch.hpp"
#include "support/judged_run.hpp"
#include "support/methods.hpp"

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

/// Height of the vertex of a body that is nearest to the y axis.
double height_at_axis(const std::vector<glm::dvec3>& places)
{
    const auto off = [](const glm::dvec3& x) { return std::hypot(x.x, x.z); };
    return std::min_element(places.begin(), places.end(),
                            [&](const auto& a, const auto& b) { return off(a) < off(b); })
        ->y;
}

} // namespace

TEST_CASE("suite 08: a tube is twisted by one and a half turns and does not cross itself")
{
    JudgedRun run(suite("08_twisted_tube"));
    run.run(3);
    CHECK(run.intersected == 0);
    CHECK(run.world.contacts().pinched == 0);
    CHECK(run.verdict.nearest.distance > 0);
    double waist = 1; // it has closed in the middle
    for (const glm::dvec3& x : run.body(0))
        waist = std::min(waist, std::hypot(x.y, x.z));
    CHECK(waist < 0.03);
}

TEST_CASE("suite 14: ribbons that fall into a bowl lie in it, and it carries them")
{
    JudgedRun run(suite("14_bowl"));
    run.run(1.5);
    CHECK(run.crossed == 0);
    double weight = 0, carried = 0;
    const Scene& scene = run.world.scene();
    for (std::size_t b = 1; b < scene.bodies.size(); ++b)
    {
        weight += 9.81 * sheet_mass(scene, b);
        for (const glm::dvec3& x : run.body(b))
            CHECK((x.y < 0 && glm::length(x) < 0.2));
    }
    for (const BodyContactForce& f : run.world.contact_forces())
        carried -= f.a == 0 ? f.force.y : 0;
    CHECK(carried == Approx(weight).epsilon(0.05));
}

TEST_CASE("suite 16: a heavy ball that is thrown onto three sheets stays above all of them")
{
    JudgedRun run(suite("16_through_layers"));
    run.run(0.5);
    CHECK(run.intersected == 0);
    const double ball = run.centre(3).y;
    CHECK(ball < 0); // it has drawn them down
    for (std::size_t b = 0; b < 3; ++b)
    {
        const double sheet = height_at_axis(run.body(b));
        CHECK(sheet < ball - 0.03);
        CHECK(sheet > height_at_axis(run.body(std::min<std::size_t>(b + 1, 2))) - 1e-9);
    }
}

TEST_CASE("suite 17: a ball presses two sheets onto the tip of a spike, which does not pierce them")
{
    JudgedRun run(suite("17_needle"));
    run.run(1);
    CHECK(run.intersected == 0);
    CHECK(run.nearest_parts > 0);
}

TEST_CASE("suite 18: cloth lies on spikes and is drawn off them")
{
    JudgedRun run(suite("18_spikes"));
    run.run(1);
    const double lies = run.centre(1).x;
    CHECK(run.nearest_parts > 0.9 * 0.008);
    run.run(2.8);
    CHECK(run.crossed == 0);
    CHECK(run.centre(1).x < lies - 0.15);
}

TEST_CASE("suite 36: cloth between walls that close is clean until it is pinched, and then that is counted")
{
    JudgedRun run(suite("36_compactor"));
    run.run(1.6);
    CHECK(run.intersected == 0);
    CHECK(run.world.contacts().pinched == 0);
    run.run(2.5);
    CHECK(run.world.contacts().pinched > 0);
    // Nothing was thrown out: no vertex has more energy than the highest one of the start.
    const auto cloth = run.body(3);
    const auto velocities = run.world.velocities();
    const std::size_t first = run.world.plan().body_start[3];
    for (std::size_t v = 0; v < cloth.size(); ++v)
        CHECK(0.5 * glm::dot(velocities[first + v], velocities[first + v]) + 9.81 * cloth[v].y < 9.81 * 0.4);
}

TEST_CASE("suite 38: a sleeve that limbs pinch again and again crosses nothing a second after they open")
{
    const std::string method = GENERATE("xpbd", "implicit_euler");
    CAPTURE(method);
    JudgedRun run(test::under(suite("38_elbow"), method));
    for (int cycle = 0; cycle < 3; ++cycle)
    {
        CAPTURE(cycle);
        const std::size_t before = run.intersected;
        run.run(1.8 * cycle + 0.8);
        CHECK(run.intersected > before); // the limbs overlap, and the sleeve is between them
        const std::size_t pinched = run.intersected;
        run.run(1.8 * cycle + 1.0);
        CHECK(run.intersected < pinched + 8);
        const std::size_t open = run.intersected;
        run.run(1.8 * (cycle + 1));
        CHECK(run.intersected == open);
        CHECK(run.verdict.intersecting == 0);
    }
    CHECK((method != "xpbd" || run.world.contacts().untangled > 0)); // the other leaves nothing crossed
    CHECK(run.world.events().non_finite == 0);
}

TEST_CASE("suite 50: a flat sheet much thicker than its edges are long stays as it is")
{
    JudgedRun run(suite("50_thick"));
    const std::vector<glm::dvec3> start = run.body(0);
    run.run(0.5);
    CHECK(run.crossed == 0);
    double moved = 0;
    for (std::size_t v = 0; v < start.size(); ++v)
        moved = std::max(moved, glm::distance(start[v], run.body(0)[v]));
    CHECK(moved < 1e-5 * 0.2);
}

TEST_CASE("suite 51: loops that hang in each other stay linked, however far they are pulled")
{
    JudgedRun run(suite("51_loops"));
    const auto linking = run.judge.look(run.before).linking;
    run.run(2);
    CHECK(run.intersected == 0);
    CHECK(run.verdict.linking == linking);
    CHECK(std::count_if(linking.begin(), linking.end(), [](const auto& n) { return n && *n != 0; }) > 0);
    CHECK(run.verdict.stretch > 0.5); // they are much too short
}

TEST_CASE("suite 57: sheets on a ball keep their strain limit, and lie a gap above it and each other")
{
    const auto stretch = [](double limit) {
        Scene scene = suite("57_limited");
        scene.bodies[1].material.strain_limit = scene.bodies[2].material.strain_limit = limit;
        JudgedRun run(scene);
        run.run(1);
        CHECK(run.crossed == 0);
        CHECK(run.nearest_parts > 0.9 * 0.008);
        return measure(run.world).max_stretch;
    };
    CHECK(stretch(0.05) < 0.06);
    CHECK(stretch(0) > 0.08);
}
