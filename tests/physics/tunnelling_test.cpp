// Only vertices collide, so a fast or small collider can pass between them: a run notices, and calm runs are
// silent.

#include "support/catch.hpp"
#include "support/solid_angle.hpp"
#include "taut/report/crossing.hpp"
#include "taut/runtime/device.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace {

using namespace taut;

/// A square metre of cloth that lies level, its middle at the origin.
Scene level(std::uint32_t cells, const std::string& method)
{
    Scene scene;
    Body body;
    body.name = "cloth";
    body.shape.cells = {cells, cells};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.stability = StabilityRule::substep;
    return scene;
}

void hold_edges(Scene& scene)
{
    scene.bodies[0].pins.emplace_back().edges = {"top", "bottom", "left", "right"};
}

/// Shows `frames` frames to a watch, as `taut run` does at the least.
Crossings watched(const Scene& scene, int frames)
{
    World world(scene, Device::open("cpu:serial"));
    CrossingWatch watch(world.scene());
    const double substep = world.scene().timestep / world.plan().substeps;
    double looked = 0;
    for (int frame = 0; frame <= frames; ++frame)
    {
        if (frame == 0 || frame == frames || world.time() + scene.timestep - looked > watch.clear_for())
        {
            watch.look(static_cast<std::uint64_t>(frame), world.time(), substep, world.positions(),
                       world.velocities());
            looked = world.time();
        }
        world.step();
    }
    return watch.found();
}

/// Whether it does pass, by a run of the same substeps that is looked at after each.
bool passes(Scene scene, int frames)
{
    const std::uint32_t substeps = World(scene, Device::open("cpu:serial")).plan().substeps;
    scene.timestep /= substeps;
    scene.method.substeps = 1;
    World world(scene, Device::open("cpu:serial"));
    test::Truth truth;
    for (std::uint32_t step = 0; step <= static_cast<std::uint32_t>(frames) * substeps; ++step)
    {
        truth.look(world.scene(), world.time(), world.positions());
        world.step();
    }
    REQUIRE(truth.finite());
    return truth.through();
}

const char* const kMethods[] = {"xpbd", "pbd", "vbd", "implicit_euler", "mass_spring"};

TEST_CASE("cloth at 100 m/s that parts round a ball of five edges and closes behind it is noticed")
{
    for (const char* method : kMethods)
    {
        INFO(method);
        Scene scene = level(16, method);
        scene.bodies[0].velocity = {0, -100, 0};
        scene.colliders.resize(1);
        scene.colliders[0].name = "ball";
        scene.colliders[0].radius = 5.0 / 16;
        scene.colliders[0].point = {0, -0.5, 0};
        const Crossings found = watched(scene, 10);
        const bool truth = passes(scene, 10);
        CHECK(found.seen.size() == (truth ? 1 : 0));
        if (std::string(method) == "vbd") // whose sweeps know of the ball
            CHECK_FALSE(truth);
        else
            CHECK((truth || std::string(method) == "mass_spring")); // of many substeps
        for (const Crossing& c : found.seen)
        {
            CHECK(c.body == "cloth");
            CHECK(c.collider == "ball");
        }
    }
}

TEST_CASE("a ball, a capsule and a plate at 200 m/s that pass cloth held on four edges are noticed")
{
    for (const char* method : kMethods)
        for (const ColliderKind kind : {ColliderKind::sphere, ColliderKind::capsule, ColliderKind::cuboid})
        {
            INFO(method << ", shape " << static_cast<int>(kind));
            Scene scene = level(16, method);
            hold_edges(scene);
            scene.colliders.resize(1);
            Collider& thing = scene.colliders[0];
            thing.kind = kind;
            thing.radius = 0.1;
            thing.point = {0.03, 0.5, 0.02};
            thing.end = {0.13, 0.6, 0.02};
            thing.half_size = {0.2, 0.01, 0.2};
            thing.motion = {{0, {}}, {0.1, {0, -20, 0}}};
            const Crossings found = watched(scene, 6);
            // A plate carries cloth along, which may pass beside its centre: the truth is only of that.
            const bool truth = passes(scene, 6);
            CHECK((truth || kind == ColliderKind::cuboid));
            if (truth)
            {
                CHECK(found.seen.size() == 1);
                CHECK(found.passed > 0);
            }
        }
}

TEST_CASE("a small ball slips through a coarse grid without touching a vertex, and is noticed")
{
    for (const char* method : kMethods)
    {
        INFO(method);
        Scene scene = level(4, method);
        hold_edges(scene);
        scene.gravity = glm::dvec3(0);
        scene.colliders.resize(1);
        scene.colliders[0].radius = 0.04;
        scene.colliders[0].meets = ColliderMeets::vertices;
        scene.colliders[0].point = {0.08, 0.3, 0.15}; // over a triangle
        scene.colliders[0].motion = {{0, {}}, {1, {0, -0.6, 0}}};
        REQUIRE(passes(scene, 60));
        const Crossings found = watched(scene, 60);
        CHECK(found.seen.size() == 1);
        CHECK(found.passed > 0);
        CHECK(found.likely.size() == 1);
    }
}

TEST_CASE("cloth that lies down on a ball, a capsule or a box, or is struck gently, is not warned of")
{
    for (const char* method : kMethods)
        for (const ColliderKind kind : {ColliderKind::sphere, ColliderKind::capsule, ColliderKind::cuboid})
        {
            INFO(method << ", shape " << static_cast<int>(kind));
            Scene scene = level(16, method);
            scene.colliders.resize(1);
            Collider& thing = scene.colliders[0];
            thing.kind = kind;
            thing.radius = 0.25;
            thing.friction = 0.5;
            thing.point = {-0.1, -0.3, 0};
            thing.end = {0.2, -0.3, 0.1};
            thing.half_size = {0.25, 0.2, 0.2};
            const Crossings found = watched(scene, 60);
            CHECK(found.seen.empty());
            CHECK(found.likely.empty());
            CHECK(found.passed == 0);
        }
}

} // namespace
