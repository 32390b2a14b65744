// Bodies that are led, met by cloth: it rests on them, is carried and turned by them, and gives nothing back.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sheets.hpp"

#include "taut/report/report.hpp"
#include "taut/report/scene_budget.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>

using namespace taut;

namespace {

constexpr double kRadius = 0.002, kGap = 2 * kRadius;

/// A box whose upper side is at height 0, with cloth just above it.
Scene cloth_on_box()
{
    Scene scene;
    Body box;
    box.shape.kind = ShapeKind::box;
    box.shape.box_cells = {3, 2, 3};
    box.shape.box_size = {0.4, 0.1, 0.4};
    box.transform.translate = {0, -0.05, 0};
    box.material = solid_material();
    box.material.thickness = kRadius;
    box.kinematic.used = true;
    scene.bodies = {box, test::level_sheet(6, 0.2, {0, 1.2 * kGap, 0}, kRadius)};
    scene.contact.between = true;
    scene.contact.friction = 0.5;
    scene.method.substeps = 15;
    return scene;
}

std::vector<glm::dvec3> cloth_of(const World& world)
{
    const auto x = world.positions();
    return {x.begin() + world.plan().body_start[1], x.end()};
}

} // namespace

TEST_CASE("cloth rests a gap above a kinematic solid, which does not move")
{
    World world(cloth_on_box(), test_device("cpu:serial"));
    const auto start = world.positions();
    CHECK(test::crossed_in(world, 60) == 0);
    for (const glm::dvec3& p : cloth_of(world))
        CHECK(std::abs(p.y - kGap) < 0.05 * kGap);
    const auto end = world.positions();
    for (std::size_t v = 0; v < world.plan().body_start[1]; ++v)
        CHECK(end[v] == start[v]);
    CHECK(measure(world).status == Status::completed);
}

TEST_CASE("a kinematic body that rises carries cloth")
{
    Scene scene = cloth_on_box();
    scene.bodies[0].kinematic.motion = {{0.5}, {2.5, {0, 1, 0}}};
    World world(scene, test_device("cpu:serial"));
    CHECK(test::crossed_in(world, 90) == 0);
    for (const glm::dvec3& p : cloth_of(world))
        CHECK(std::abs(p.y - (0.5 + kGap)) < 0.1 * kGap);
    CHECK(measure(world).status == Status::completed);
}

TEST_CASE("cloth turns with a kinematic body that turns, by friction alone")
{
    Scene scene = cloth_on_box();
    scene.bodies[0].kinematic.motion = {{0.5}, {2.5, {0, 0, 0}, {0, 1, 0}, 90}};
    // Normals that coarse steps leave slanted turn cloth, too: by 0.005 to 0.05 with 15 substeps, whatever
    // the sweeps.
    scene.method.substeps = 60;
    scene.contact.sweeps = 16;
    const auto turned = [&](double friction) {
        scene.contact.friction = friction;
        World world(scene, test_device("cpu:serial"));
        const glm::dvec3 before = cloth_of(world).front();
        CHECK(test::crossed_in(world, 90) == 0);
        const glm::dvec3 after = cloth_of(world).front();
        return std::remainder(std::atan2(before.z, before.x) - std::atan2(after.z, after.x),
                              glm::two_pi<double>());
    };
    CHECK(turned(0.5) == Approx(glm::quarter_pi<double>()).margin(0.01));
    CHECK(std::abs(turned(0)) < 0.01);
}

TEST_CASE("a sequence and the same places by the program are bit-equal, on every executor")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    Scene scene = resolve(cloth_on_box());
    auto places = std::make_shared<SequencePlaces>();
    places->rate = 1 / scene.timestep;
    const auto rest = scene.bodies[0].mesh.positions;
    constexpr int kFrames = 12;
    for (int f = 0; f <= kFrames; ++f)
    {
        places->frames.push_back(rest);
        for (glm::dvec3& p : places->frames.back()) // swells on one side, and rises
            p.y += 0.01 * f * (1 + p.x) / kFrames;
    }
    Scene led = scene;
    led.bodies[0].pins[0].places = places;
    World sequence(led, test_device(selector));
    scene.bodies[0].pins[0].moved_by_program = true;
    World program(scene, test_device(selector));
    for (int f = 1; f <= kFrames; ++f)
    {
        // Where the sequence is at the end of the step: its time is a sum of steps.
        std::vector<glm::dvec3> targets;
        for (std::size_t v = 0; v < rest.size(); ++v)
            targets.push_back(place_at(*places, sequence.time() + scene.timestep, v));
        program.set_pin_targets(targets);
        sequence.step();
        program.step();
    }
    CHECK((sequence.state().position == program.state().position));
    CHECK((sequence.state().velocity == program.state().velocity));
    CHECK(cloth_of(sequence).front().y > kGap + 0.005);
}

TEST_CASE("a mesh that kicks cloth at ten metres a second is no blow-up")
{
    Scene scene = resolve(cloth_on_box());
    auto places = std::make_shared<SequencePlaces>();
    places->rate = 25;
    for (int f = 0; f < 8; ++f)
    {
        places->frames.push_back(scene.bodies[0].mesh.positions);
        for (glm::dvec3& p : places->frames.back())
            p.y += f < 2 ? 0 : 0.4 * (f == 2 || f > 5 ? 1 : f - 1);
    }
    scene.bodies[0].pins[0].places = places;
    World world(scene, test_device("cpu:serial"));
    const SceneBudget budget(world.scene());
    for (int step = 1; step <= 30; ++step)
    {
        world.step();
        CHECK(judge(budget, world, Judged::motion).status == Status::completed);
    }
    CHECK(cloth_of(world).front().y > 0.4); // it was thrown
}
