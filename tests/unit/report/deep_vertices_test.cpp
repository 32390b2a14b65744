// How deep vertices lie in colliders, and what momentum is missing: what ends a run as unconverged.

#include "support/catch.hpp"

#include "taut/report/deep_vertices.hpp"
#include "taut/report/report.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/world.hpp"

#include <cmath>

using namespace taut;

namespace {

/// Two squares of cloth of 1 m beside each other, level, y = 0; the second has a pin at a corner.
Scene two_sheets(std::vector<Collider> colliders)
{
    Body first, second;
    first.name = "left";
    first.shape.cells = second.shape.cells = {2, 2};
    first.transform.rotate_axis = {1, 0, 0};
    first.transform.rotate_degrees = -90;
    second.transform = first.transform;
    second.transform.translate = {3, 0, 0};
    Pin pin;
    pin.corners = {"top_left"};
    second.pins = {pin};
    Scene scene;
    scene.bodies = {first, second};
    scene.colliders = std::move(colliders);
    return resolve(scene);
}

Collider floor_at(double height)
{
    Collider floor;
    floor.name = "floor";
    floor.kind = ColliderKind::plane;
    floor.point = {0, height, 0};
    floor.normal = {0, 1, 0};
    return floor;
}

std::vector<glm::dvec3> places(const Scene& scene)
{
    std::vector<glm::dvec3> out;
    for (const Body& body : scene.bodies)
        out.insert(out.end(), body.mesh.positions.begin(), body.mesh.positions.end());
    return out;
}

} // namespace

TEST_CASE("the deepest free vertex of each body in each collider is found")
{
    const Scene scene = two_sheets({floor_at(-9), floor_at(0.25)});
    std::vector<glm::dvec3> x = places(scene);
    x[4].y = -0.5;
    const std::uint32_t held = scene.bodies[1].pins[0].vertices.at(0);
    x[9 + held].y = -7; // nobody asks that of a pin
    const std::vector<DeepVertex> deep = deep_vertices(scene, x, 0);
    REQUIRE(deep.size() == 2);
    CHECK((deep[0].body == 0 && deep[0].collider == 1 && deep[0].vertex == 4));
    CHECK(deep[0].depth == Approx(0.75));
    CHECK(deep[0].size == Approx(std::sqrt(2.0)));
    CHECK((deep[1].body == 1 && deep[1].collider == 1));
    CHECK(deep[1].depth == Approx(0.25));
}

TEST_CASE("a body deeper in a collider than a hundredth of its size is unconverged, and named")
{
    const Scene scene = two_sheets({floor_at(0)});
    std::vector<glm::dvec3> x = places(scene);
    x[4].y = -0.014;
    CHECK(judge_depth(scene, deep_vertices(scene, x, 0)).sound());
    x[4].y = -0.015;
    const Soundness found = judge_depth(scene, deep_vertices(scene, x, 0));
    CHECK(found.status == Status::unconverged);
    CHECK_THAT(found.reason, Contains("vertex 4 of bodies[0] (left) ends 0.015 m deep in "));
    CHECK_THAT(found.reason, Contains("colliders[0] (floor)"));
}

TEST_CASE("what two colliders leave no room is nobody's error")
{
    Collider ceiling = floor_at(-0.1);
    ceiling.normal = {0, -1, 0};
    const Scene scene = two_sheets({floor_at(0.1), ceiling});
    const std::vector<DeepVertex> deep = deep_vertices(scene, places(scene), 0);
    REQUIRE(deep.size() == 4);
    CHECK(deep[0].depth == Approx(0.1));
    CHECK(judge_depth(scene, deep).sound());
}

TEST_CASE("a particle on a floor is as deep as rounding, whatever its size")
{
    Body particle;
    particle.shape.kind = ShapeKind::chain;
    particle.shape.links = 0;
    Scene scene;
    scene.bodies = {particle};
    scene.colliders = {floor_at(1e-9)};
    scene = resolve(scene);
    CHECK(judge_depth(scene, deep_vertices(scene, std::vector{glm::dvec3(0.5, 0, 0)}, 0)).sound());
    CHECK_FALSE(judge_depth(scene, deep_vertices(scene, std::vector{glm::dvec3(0.5, -1, 0)}, 0)).sound());
}

TEST_CASE("a start within a collider is warned of, also where it is out of in the pose at the start")
{
    Collider floor = floor_at(-1);
    CHECK(deep_start_issues(two_sheets({floor})).empty());
    floor.motion = {{0, {0, 1.5, 0}}, {1, {0, 0, 0}}};
    const std::vector<SceneIssue> issues = deep_start_issues(two_sheets({floor}));
    REQUIRE(issues.size() == 2);
    CHECK_FALSE(issues[0].error);
    CHECK(issues[0].field == "bodies[0]");
    CHECK_THAT(issues[0].text, Contains("0.5 m deep"));
}

TEST_CASE("a run that ends within a collider is no result; one that has the time to come out is")
{
    for (const auto& [depth, status] : {std::pair{0.05, Status::completed}, {2.0, Status::unconverged}})
    {
        CAPTURE(depth);
        World world(two_sheets({floor_at(depth)}), Device::open("cpu:serial"));
        for (int frame = 0; frame < 30; ++frame)
            world.step();
        const StepReport report = measure(world);
        CHECK(report.status == status);
        CHECK((status == Status::completed || report.penetration > 1));
    }
}

TEST_CASE("momentum that nobody took is missed")
{
    Scene scene = two_sheets({});
    scene.bodies[1].pins.clear();
    scene.gravity = glm::dvec3(0);
    scene.bodies[0].velocity = {2, 0, 0};
    scene.bodies[1].velocity = {-1, 0, 0};
    World world(scene, Device::open("cpu:serial"));
    world.step();
    CHECK(measure(world).momentum_error < 1e-5);
    CHECK(measure(world).status == Status::completed);
    std::vector<glm::dvec3> v = world.velocities();
    for (std::size_t i = 0; i < 9; ++i)
        v[i] *= 0.5; // 1 of the 3 m/s that both part with
    world.set_velocities(v);
    CHECK(measure(world).momentum_error == -1); // its program did that
    WorldState state = world.state();
    state.kick = 0; // as if nobody had
    world.restore(state);
    const StepReport lost = measure(world);
    CHECK(lost.momentum_error == Approx(0.5 / std::sqrt(2.5)).epsilon(1e-3));
    CHECK(lost.status == Status::unconverged);
    CHECK_THAT(lost.reason, Contains("momentum"));
}

TEST_CASE("what lies still, is pulled apart or is cut at its max_speed has its momentum")
{
    Scene scene = two_sheets({});
    scene.bodies[1].pins.clear();
    scene.gravity = glm::dvec3(0);
    const auto ends = [](const Scene& of) {
        World world(of, Device::open("cpu:serial"));
        for (int frame = 0; frame < 20; ++frame)
            world.step();
        return measure(world);
    };
    CHECK(ends(scene).status == Status::completed); // rounding is all that moves it
    Scene drawn = scene;
    drawn.bodies[0].start_positions = drawn.bodies[0].mesh.positions;
    for (glm::dvec3& p : drawn.bodies[0].start_positions)
        p *= 1.05;
    CHECK(ends(drawn).status == Status::completed);
    Scene cut = scene;
    cut.bodies[0].velocity = {2, 0, 0};
    cut.max_speed = 1;
    CHECK(ends(cut).momentum_error == -1);
}
