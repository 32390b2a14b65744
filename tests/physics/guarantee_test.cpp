// Surfaces that never cross (docs/contact.md, "The guarantee"), whatever is thrown at them; judged by
// src/judge, which shares nothing with the kernels.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/expect.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"
#include "support/thrown_run.hpp"
#include "support/thrown_sheets.hpp"

#include "taut/judge/judge.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

using namespace taut;

TEST_CASE("thrown sheets never cross with the guarantee, and do without")
{
    const double origin = GENERATE(0.0, 1.0, 30.0);
    const double speed = GENERATE(1.0, 10.0, 60.0);
    CAPTURE(origin, speed);
    std::size_t met = 0, filtered = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed)
    {
        Scene scene = test::thrown_sheets(1000 + seed, {1, 1, origin, speed, false});
        met += test::run_thrown(scene, 30, true).met;
        scene.contact.guarantee = Guarantee::no_crossing;
        const test::Crossed guarded = test::run_thrown(scene, 30, true);
        CAPTURE(seed, guarded.counts.filtered, guarded.counts.held, guarded.counts.pinched);
        CHECK(guarded.met == 0);
        CHECK(guarded.counts.pinched == 0);
        filtered += guarded.counts.filtered;
    }
    CHECK(met > 0);
    CHECK(filtered > 0);
}

TEST_CASE("thrown sheets never cross with the guarantee, under every other method")
{
    const std::string method =
        GENERATE("mass_spring", "implicit_euler", "implicit_constraints", "acad", "pbd", "vbd");
    CAPTURE(method);
    const bool many_substeps = method == "mass_spring" || method == "acad";
    std::size_t met = 0, filtered = 0;
    for (std::uint64_t seed = 0; seed < (many_substeps ? 1 : 8); ++seed)
    {
        Scene scene = test::under(test::thrown_sheets(2000 + seed, {1, 1, 0, 40, false}), method);
        // Ways are straight where a step is one substep: explicit methods take several.
        const bool ways = World(scene, test_device("cpu:serial")).plan().substeps == 1;
        met += test::run_thrown(scene, 20, ways).met;
        scene.contact.guarantee = Guarantee::no_crossing;
        const test::Crossed guarded = test::run_thrown(scene, 20, ways);
        CAPTURE(seed, guarded.counts.filtered, guarded.counts.held, guarded.counts.pinched);
        CHECK(guarded.met == 0);
        CHECK(guarded.counts.pinched == 0);
        filtered += guarded.counts.filtered;
    }
    CHECK((met > 0 || method == "acad")); // whose many substeps and searches leave none to cross
    CHECK(filtered > 0);
}

namespace {

Body level_sheet(std::uint32_t cells, double size, const glm::dvec3& centre)
{
    return test::level_sheet(cells, size, centre, 0.001);
}

std::string refusal_of(const Scene& scene)
{
    try
    {
        World(scene, test_device("cpu:serial"));
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "";
}

} // namespace

namespace {

/// A corner drawn far down, between two triangles that hold it; between these there is nothing.
Body sling()
{
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh.positions = {{0, 0.9, 0}, {0.5, 1, 0}, {0.6, 1, 0}, {-0.5, 1, 0}, {-0.6, 1, 0}};
    body.mesh.triangles = {{0, 1, 2}, {0, 4, 3}};
    body.start_positions = body.mesh.positions;
    body.start_positions[0] = {0.003, -0.2, 0.005};
    body.material.stretch_stiffness = 1e4;
    body.material.thickness = 0.002;
    Pin pin;
    pin.vertices = {1, 2, 3, 4};
    body.pins = {pin};
    return body;
}

/// A sling and another body, in one substep a step: then its way is straight.
Scene slung(const Body& other)
{
    Scene scene = resolve(test::guarded_scene({other})); // of two bodies both have meshes, or neither
    scene.bodies.insert(scene.bodies.begin(), sling());
    scene.method.substeps = 1;
    return scene;
}

} // namespace

TEST_CASE("what a stretched strip throws further than its search looked stops at the other surface")
{
    Body tile = level_sheet(2, 0.08, {0, 0, 0});
    tile.pins = {Pin{}};
    tile.pins[0].edges = {"top", "bottom", "left", "right"};
    Scene scene = slung(tile);
    const test::Crossed guarded = test::run_thrown(scene, 10, true);
    CHECK(guarded.met == 0);
    CHECK(guarded.counts.filtered > 0);
    scene.contact.guarantee = Guarantee::none;
    CHECK(test::run_thrown(scene, 10, true).met > 0);
}

TEST_CASE("layers that fall together are not held up by the guarantee")
{
    Scene scene = test::guarded_scene({});
    for (int k = 0; k < 4; ++k)
    {
        Body sheet = level_sheet(6, 0.12, {0.001 * k, 0.004 * k, 0});
        sheet.velocity = {2, -8, 0}; // 13 mm a substep, 4 mm from one to the next
        sheet.contact.self = true;
        scene.bodies.push_back(sheet);
    }
    World guarded(scene, test_device("cpu:serial"));
    scene.contact.guarantee = Guarantee::none;
    World free(scene, test_device("cpu:serial"));
    for (int step = 0; step < 10; ++step)
    {
        guarded.step();
        free.step();
    }
    const ContactCounts counts = guarded.contacts();
    CAPTURE(counts.pairs, counts.held, counts.cut, counts.crowded, counts.missing, counts.capacity);
    REQUIRE(counts.pairs > 500);
    CHECK(guarded.contacts().filtered == 0);
    CHECK((guarded.positions() == free.positions()));
}

TEST_CASE("a sheet that strikes a held one at any speed ends above it, and gains nothing by the filter")
{
    const double speed = GENERATE(3.0, 30.0, 300.0);
    CAPTURE(speed);
    Scene scene =
        test::guarded_scene({level_sheet(10, 0.3, {0, 0, 0}), level_sheet(7, 0.15, {0.011, 0.05, 0.007})});
    test::hold_all(scene.bodies[0], {});
    scene.bodies[1].velocity = {0, -speed, 0};
    scene.bodies[1].contact.self = true;
    scene.gravity = glm::dvec3(0);
    World world(scene, test_device("cpu:serial"));
    const test::Meant meant(world.scene());
    const judging::Judge judge(meant.all.triangles, world.positions());
    double energy = measure(world).kinetic_energy;
    const double first = energy;
    for (int step = 0; step < 12; ++step)
    {
        world.step();
        CHECK(met_between(meant, judge, world.positions(), world.positions()) == 0);
        for (const glm::dvec3& x : world.positions(1))
            CHECK((x.y > 0 || std::abs(x.x) > 0.15 || std::abs(x.z) > 0.15));
        CHECK(measure(world).kinetic_energy <= first * 1.0001);
    }
    const ContactCounts counts = world.contacts();
    CAPTURE(counts.filtered, counts.held);
    CHECK(counts.pinched == 0);
    CHECK((speed > 100 || counts.cut + counts.crowded + counts.held == 0));
    scene.contact.guarantee = Guarantee::none;
    World free(scene, test_device("cpu:serial"));
    std::size_t met = 0;
    for (int step = 0; step < 12; ++step)
    {
        const auto before = free.positions();
        free.step();
        met += met_between(meant, judge, before, free.positions());
    }
    CHECK((met > 0) == (speed > 20));
}

TEST_CASE("a held sheet that moves pushes a free one before it")
{
    Scene scene =
        test::guarded_scene({level_sheet(10, 0.3, {0, 0, 0}), level_sheet(5, 0.1, {0.011, 0.004, 0.007})});
    const double speed = GENERATE(1.0, 10.0);
    test::hold_all(scene.bodies[0], {{0, glm::dvec3(0)}, {0.2, {0, 0.2 * speed, 0}}});
    const test::Crossed guarded = test::run_thrown(resolve(scene), 12, false);
    CHECK(guarded.met == 0);
    CHECK(guarded.counts.pinched == 0);
    CHECK((guarded.counts.refined > 0) == (speed > 5)); // from rest it does not follow at once
    scene.contact.guarantee = Guarantee::none;
    CHECK((test::run_thrown(resolve(scene), 12, true).met > 0) == (speed > 5));
}

TEST_CASE("a sheet between two held ones that close is counted as pinched, and the run goes on")
{
    Scene scene =
        test::guarded_scene({level_sheet(8, 0.2, {0, 0, 0}), level_sheet(5, 0.1, {0.011, 0.02, 0.007}),
                             level_sheet(8, 0.2, {0.003, 0.04, 0.002})});
    test::hold_all(scene.bodies[0], {});
    test::hold_all(scene.bodies[2], {{0, glm::dvec3(0)}, {0.2, {0, -0.039, 0}}, {0.3, {0, -0.06, 0}}});
    World world(scene, test_device("cpu:serial"));
    std::uint64_t before_it = 0;
    for (int step = 0; step < 24; ++step)
    {
        world.step();
        if (step == 8)
            before_it = world.contacts().pinched;
    }
    CHECK(before_it == 0);
    CHECK(world.contacts().pinched > 0);
    for (const glm::dvec3& x : world.positions())
        CHECK(glm::length(x) < 1);
    CHECK(world.events().non_finite == 0);
}

TEST_CASE("with the guarantee a step whose lists are too short is done again, bit for bit")
{
    Scene scene =
        test::guarded_scene({level_sheet(10, 0.3, {0, 0, 0}), level_sheet(7, 0.15, {0.011, 0.02, 0.007})});
    // Inputs that change in every step.
    test::hold_all(scene.bodies[0], {{0, glm::dvec3(0)}, {0.2, {0, 0.05, 0}}});
    scene.bodies[1].velocity = {0, -1, 0};
    scene.bodies[1].contact.self = true;
    WorldOptions options;
    options.plan.contact_capacity = 8;
    World small(scene, test_device("cpu:serial"), options), roomy(scene, test_device("cpu:serial"));
    std::vector<glm::dvec3> lifted = roomy.positions(1);
    for (glm::dvec3& x : lifted)
        x.y += 0.001;
    small.set_positions(1, lifted); // goes with a step that is repeated
    roomy.set_positions(1, lifted);
    for (int step = 0; step < 8; ++step)
    {
        small.step();
        roomy.step();
        CHECK(small.positions() == roomy.positions());
        CHECK(small.velocities() == roomy.velocities());
    }
    CHECK(small.contacts().capacity > 8);
    CHECK(small.contacts().missing == 0);
    CHECK(small.contacts().held == 0);
    CHECK(small.contacts().filtered == roomy.contacts().filtered);
}

TEST_CASE("the guarantee is the same bit for bit on every executor")
{
    Scene scene = test::thrown_sheets(1003, {2, 1, 1, 10, false});
    scene.contact.guarantee = Guarantee::no_crossing;
    scene.method.precision = GENERATE(Precision::float32, Precision::float64);
    std::uint64_t hash = 0, filtered = 0;
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (scene.method.precision == Precision::float64 && !device->limits().float64)
            continue;
        World world(scene, device);
        for (int step = 0; step < 10; ++step)
            world.step();
        const StepReport report = measure(world);
        INFO(selector);
        CHECK(report.contacts.filtered > 0);
        hash = hash == 0 ? report.position_hash : hash;
        filtered = filtered == 0 ? report.contacts.filtered : filtered;
        if (conformance::bitwise_equal_expected(device->info()))
        {
            CHECK(report.position_hash == hash);
            CHECK(report.contacts.filtered == filtered);
        }
    }
}

TEST_CASE("the guarantee is refused by name where it cannot be given")
{
    Scene alone = test::guarded_scene({level_sheet(3, 0.1, {0, 0, 0})});
    CHECK_THAT(refusal_of(alone), Contains("contact.guarantee") && Contains("no surfaces meet"));
    alone.bodies[0].contact.self = true;
    CHECK(refusal_of(alone).empty());
    Scene torn = alone;
    torn.bodies[0].material.tear_strain = 0.2;
    CHECK_THAT(refusal_of(torn), Contains("contact.guarantee") && Contains("tear_strain"));
    Scene wrong = alone;
    wrong.contact.guarantee = static_cast<Guarantee>(2);
    CHECK_THAT(refusal_of(wrong), Contains("guarantee") && Contains("no_crossing"));
    Scene thin = alone;
    thin.bodies[0].transform.translate = {1000, 0, 0};
    CHECK_THAT(refusal_of(thin), Contains("thickness") && Contains("float needs at least"));
}

namespace {

/// How the scenes of one seed differ: fast and slow, small and large, near and far, one substep and several.
test::Throw any_throw(std::uint64_t seed)
{
    conformance::Random random(7 * seed + 3);
    const double scale = std::pow(10.0, random.uniform(-2, 1));
    return {random.chance(0.7) ? 1 : 2 + random.below(4), scale,
            random.chance(0.3) ? 0 : scale * random.uniform(0, 30), std::pow(10.0, random.uniform(-1, 2)),
            false};
}

} // namespace

TEST_CASE("no scene of many crosses with the guarantee", "[.fuzz]")
{
    const char* first = std::getenv("TAUT_FUZZ_FIRST");
    const char* count = std::getenv("TAUT_FUZZ_COUNT");
    const std::uint64_t from = first != nullptr ? std::stoull(first) : 1;
    const std::uint64_t scenes = count != nullptr ? std::stoull(count) : 200;
    std::size_t crossed = 0, pinches = 0;
    for (std::uint64_t seed = from; seed < from + scenes; ++seed)
    {
        const test::Throw how = any_throw(seed);
        Scene scene = test::thrown_sheets(seed, how);
        scene.contact.guarantee = Guarantee::no_crossing;
        if (seed % 3 == 0)
            scene.contact.searches = 1;
        const test::Crossed guarded = test::run_thrown(scene, 20, how.substeps == 1);
        const bool pinched = guarded.counts.pinched > 0; // then nothing is promised of what is next to it
        crossed += guarded.met > 0 && !pinched ? 1 : 0;
        pinches += pinched ? 1 : 0;
        INFO("seed " << seed << ", " << how.substeps << " substeps, scale " << how.scale << ", origin "
                     << how.origin << ", speed " << how.speed << ", filtered " << guarded.counts.filtered
                     << ", held " << guarded.counts.held);
        CHECK((guarded.met == 0 || pinched));
    }
    CHECK(crossed == 0);
    CHECK(pinches < scenes / 10);
}
