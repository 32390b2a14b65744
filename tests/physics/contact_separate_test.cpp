// Starts in which surfaces go through each other, or are nearer than their gap (docs/contact.md, "Starts that
// cross").

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
    REQUIRE(scene.contact.start == ContactStart::separate);
    JudgedRun run(scene);
    run.verdict = run.judge.look(run.before);
    CHECK(run.verdict.intersecting == 0);
    CHECK(run.verdict.nearest_parts.distance > kGap);
    const StepReport start = measure(run.world);
    double most = 0; // J
    run.run(1, [&] { most = std::max(most, measure(run.world).kinetic_energy); });
    CHECK(run.crossed == 0);
    CHECK(measure(run.world).status == Status::completed);
    CHECK(most < start.energy_most + 1e-10); // what crosses and is let out has 1e-4
}

} // namespace

TEST_CASE("a sheet that stands in another one, a tenth of it through, is taken out of it")
{
    Scene scene = suite("49_crossing_sheets");
    check_apart(scene);
    scene.contact.start = ContactStart::ignore;
    JudgedRun run(scene);
    CHECK(run.judge.look(run.before).intersecting > 0);
}

TEST_CASE("sheets that touch but for rounding are taken apart with the later one on top, and what moves on "
          "what is held")
{
    const bool held = GENERATE(false, true), held_first = GENERATE(false, true);
    const double turn = GENERATE(-90.0, 90.0, -63.0), shift = GENERATE(0.0, 0.007);
    CAPTURE(held, held_first, turn, shift);
    Scene scene = two_sheets(0);
    scene.bodies[1].transform.translate.z = shift;
    for (Body& body : scene.bodies)
    {
        body.transform.rotate_degrees = turn;
        if (std::abs(turn) != 90) // in one plane
            body.transform.translate = {body.transform.translate.x + 0.3, 1, 2};
    }
    if (held)
        scene.bodies[held_first ? 0 : 1].kinematic.used = true;
    scene.contact.start = ContactStart::separate;
    scene.gravity = {0, -9.81, 0};
    const Scene parted = separate_start(resolve(scene)).scene;
    const auto height = [&](std::size_t b) {
        double sum = 0;
        const std::vector<glm::dvec3> x = start_of(parted.bodies[b]);
        for (const glm::dvec3& place : x)
            sum += place.y;
        return sum / static_cast<double>(x.size());
    };
    const double least = 0.9 * kGap * std::abs(std::sin(glm::radians(turn)));
    const std::size_t low = held && !held_first ? 1 : 0;
    CHECK(height(1 - low) > height(low) + least);
}

TEST_CASE("a ball that is sunk into a sheet is taken out of it, so that the curve where they cross closes up")
{
    const Scene scene = suite("49_sunk_ball");
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(!found.crossed.empty());
    CHECK(found.farthest < 0.1); // neither is sent past the other
}

TEST_CASE("sheets that start nearer than their gap are taken apart by what is missing, the light one further")
{
    Scene scene = two_sheets(0.25 * kGap);
    scene.bodies[1].material.density *= 3;
    scene.contact.start = ContactStart::separate;
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(found.crossed.empty());
    CHECK(found.near > 0);
    CHECK(found.left == 0);
    const auto risen = [&](std::size_t b) {
        const Body& body = found.scene.bodies[b];
        return start_of(body)[0].y - body.mesh.positions[0].y;
    };
    CHECK(risen(1) - risen(0) == Approx(0.75 * kGap).epsilon(0.01));
    // Bodies of 0.2^2 and of 3 * 0.17^2 m^2 share of that by mass.
    CHECK(-risen(0) / risen(1) == Approx(3 * 0.17 * 0.17 / (0.2 * 0.2)).epsilon(0.01));
}

TEST_CASE("sheets that start in one plane are laid on each other, not beside each other")
{
    for (const double turn : {0.0, 37.0})
    {
        CAPTURE(turn);
        Scene scene = two_sheets(0);
        for (Body& body : scene.bodies)
            body.transform.rotate_degrees += turn;
        scene.bodies[1].transform.translate = {0, 0, 0};
        scene.contact.start = ContactStart::separate;
        check_apart(scene);
        CHECK(separate_start(resolve(scene)).farthest < 3 * kGap);
    }
}

TEST_CASE("a sheet that is cut in half by another one is taken out of it, however it is turned")
{
    Scene scene = suite("49_crossing_sheets");
    for (const double turn : {0.0, 21.0})
    {
        CAPTURE(turn);
        scene.bodies[0].transform.rotate_degrees = -90 + turn;
        scene.bodies[1].transform.rotate_axis = {1, 0, 0};
        scene.bodies[1].transform.rotate_degrees = turn;
        scene.bodies[1].transform.translate = {0.01, 0, 0};
        check_apart(scene);
    }
}

TEST_CASE("panels that springs sew together go as one, and what touches nothing stays")
{
    Scene scene = resolve(two_sheets(0.5 * kGap));
    Body& upper = scene.bodies[1];
    // A third panel beside the upper one, of the same body, with two seams and no common triangle.
    const Mesh panel = upper.mesh;
    const auto count = static_cast<std::uint32_t>(panel.positions.size());
    for (const glm::dvec3& x : panel.positions)
        upper.mesh.positions.push_back(x + glm::dvec3(0.5, 0, 0));
    for (const auto& t : panel.triangles)
        upper.mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
    upper.shape.kind = ShapeKind::mesh;
    upper.mesh.grid_columns = upper.mesh.grid_rows = 0;
    upper.springs = {{0, count, 0.5, 0.001}, {7, count + 7, 0.5, 0.001}};
    scene.contact.start = ContactStart::separate;
    const SeparatedStart found = separate_start(scene);
    const std::vector<glm::dvec3>& start = start_of(found.scene.bodies[1]);
    for (std::uint32_t v = 0; v < count; ++v)
        CHECK(glm::distance(start[v] + glm::dvec3(0.5, 0, 0), start[v + count]) < 1e-12);
    CHECK(start[0].y > panel.positions[0].y);
    World again(found.scene, test_device("cpu:serial"));
    CHECK(start_of(again.scene().bodies[1]) == start); // nothing is left to do

    scene.bodies[1].springs.clear();
    const SeparatedStart loose = separate_start(scene);
    CHECK(start_of(loose.scene.bodies[1])[count] == scene.bodies[1].mesh.positions[count]);
}

TEST_CASE("surfaces that are held nearer than their gap are left alone, and are no energy")
{
    Scene scene = two_sheets(0.5 * kGap);
    for (Body& body : scene.bodies)
        test::hold_all(body);
    CHECK(deepest_contact(resolve(scene)) == 0);
    CHECK(separate_start(resolve(scene)).near == 0);
}

TEST_CASE("a scene that is no scene is refused before its surfaces are looked at")
{
    Scene scene = resolve(two_sheets(0));
    for (const char* start : {"separate", "refuse"})
    {
        scene.contact.start = option_named<ContactStart>(start);
        scene.bodies[0].pins = {Pin{}};
        scene.bodies[0].pins[0].vertices = {100000};
        CHECK_THROWS_WITH(World(scene, test_device("cpu:serial")), Contains("pins[0].vertices"));
    }
}

TEST_CASE("a start without anything to take apart is the scene as it was")
{
    const Scene scene = resolve(two_sheets(1.5 * kGap));
    const SeparatedStart found = separate_start(scene);
    CHECK(found.crossed.empty());
    CHECK(found.near == 0);
    CHECK(found.farthest == 0);
    CHECK(found.scene.bodies[1].start_positions.empty());
}

TEST_CASE("what is held stays where it is, and what is loose goes all the way")
{
    Scene scene = two_sheets(0.5 * kGap);
    test::hold_all(scene.bodies[0]);
    scene.contact.start = ContactStart::separate;
    check_apart(scene);
    const SeparatedStart found = separate_start(resolve(scene));
    CHECK(start_of(found.scene.bodies[0]) == found.scene.bodies[0].mesh.positions);
}

TEST_CASE("cloth that is folded through itself is taken apart")
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
    scene.contact.start = ContactStart::separate;
    const StartSurfaces before(resolve(scene));
    REQUIRE(!before.crossings(before.places()).empty());
    JudgedRun run(scene);
    CHECK(run.judge.look(run.before).intersecting == 0);
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
    scene.contact.start = ContactStart::separate;
    CHECK_THROWS_WITH(World(scene, test_device("cpu:serial")),
                      Contains("could not be taken apart") && Contains("(\"first\")"));
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
