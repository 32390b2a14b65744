// Starts in which surfaces go through each other, or are nearer than their gap (docs/contact.md, "Starts").

#include "support/catch.hpp"
#include "support/judged_run.hpp"
#include "support/sheets.hpp"

#include "taut/scene/pose.hpp"
#include "taut/world/separate_start.hpp"
#include "taut/world/start_surfaces.hpp"


using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius;

/// Two loose sheets without gravity, `apart` metres from each other.
Scene two_sheets(double apart)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.bodies = {test::level_sheet(8, 0.2, {0, 0, 0}, kRadius),
                    test::level_sheet(7, 0.17, {0.01, apart, 0.02}, kRadius)};
    scene.contact.between = true;
    scene.method.substeps = 20;
    return scene;
}

/// Nothing crosses from the start on, nothing moves but by what lengths are still off, and the run is sound.
void check_apart(const Scene& scene)
{
    REQUIRE(scene.contact.start == "separate");
    JudgedRun run(scene);
    run.verdict = run.judge.look(run.before);
    CHECK(run.verdict.intersecting == 0);
    CHECK(run.verdict.nearest_parts.distance > kGap);
    const StepReport start = measure(run.world);
    run.run(1);
    CHECK(run.crossed == 0);
    const StepReport end = measure(run.world);
    CHECK(end.status == Status::completed);
    CHECK(end.kinetic_energy < start.energy_most + 1e-10); // J; what crosses and is let out has 1e-4
}

} // namespace

TEST_CASE("a sheet that stands in another one, a tenth of it through, is taken out of it")
{
    Scene scene = suite("49_crossing_sheets");
    check_apart(scene);
    scene.contact.start = "ignore";
    JudgedRun run(scene);
    CHECK(run.judge.look(run.before).intersecting > 0);
}

TEST_CASE("a ball that is sunk into a sheet is taken out of it, so that the curve where they cross closes up")
{
    const Scene scene = suite("49_sunk_ball");
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(found.crossed > 0);
    CHECK(found.farthest < 0.1); // neither is sent past the other
}

TEST_CASE("sheets that start nearer than their gap are taken apart by what is missing, the light one further")
{
    Scene scene = two_sheets(0.25 * kGap);
    scene.bodies[1].material.density *= 3;
    scene.contact.start = "separate";
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(found.crossed == 0);
    CHECK(found.near > 0);
    CHECK(found.farthest < 0.75 * 1.1 * kGap);
    CHECK(found.farthest > 0.75 / 2 * kGap);
}

TEST_CASE("a start without anything to take apart is the scene as it was")
{
    const Scene scene = resolve(two_sheets(1.5 * kGap));
    const SeparatedStart found = separate_start(scene);
    CHECK(found.crossed + found.near == 0);
    CHECK(found.farthest == 0);
    CHECK(found.scene.bodies[1].start_positions.empty());
}

TEST_CASE("what is held stays where it is, and what is loose goes all the way")
{
    Scene scene = two_sheets(0.5 * kGap);
    test::hold_all(scene.bodies[0]);
    scene.contact.start = "separate";
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(start_of(found.scene.bodies[0]) == found.scene.bodies[0].mesh.positions);
}

TEST_CASE("cloth that is crumpled through itself is taken apart, or refused by name")
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.bodies = {test::level_sheet(16, 0.2, {0, 0, 0}, 0.001)};
    scene.bodies[0].contact.self = true;
    scene.bodies[0].start_positions = resolve(scene).bodies[0].mesh.positions;
    // A strip of it is folded over and pushed 4 mm through the rest.
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        if (x.x > 0.02)
            x = {0.04 - x.x, 0.02 - 0.6 * (x.x - 0.02), x.z};
    scene.contact.start = "separate";
    const StartSurfaces before(resolve(scene));
    REQUIRE(!before.crossings(before.places()).empty());
    JudgedRun run(scene);
    run.run(0.5);
    CHECK(run.crossed == 0);
    CHECK(measure(run.world).status == Status::completed);
}

TEST_CASE("what cannot be taken apart is refused, and named")
{
    Scene scene = two_sheets(0);
    scene.bodies[0].name = "first";
    scene.bodies[1].transform.rotate_degrees = -80;
    for (Body& body : scene.bodies)
        test::hold_all(body);
    scene.contact.start = "separate";
    CHECK_THROWS_WITH(World(scene, test_device("cpu:serial")),
                      Catch::Contains("could not be taken apart") && Catch::Contains("(\"first\")"));
}

TEST_CASE("a start nearer than the gap that is let out by contact has not made energy")
{
    for (const double part : {0.1, 0.5, 0.9})
    {
        CAPTURE(part);
        Scene scene = two_sheets(part * kGap);
        World world(scene, test_device("cpu:serial"));
        for (int k = 0; k < 30; ++k)
            world.step();
        const StepReport report = measure(world);
        CHECK(report.kinetic_energy > 1e-6); // it was let out
        CHECK(report.status == Status::completed);
    }
}
