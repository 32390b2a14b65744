#include "support/catch.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

using namespace taut;

namespace {

using Indices = std::vector<std::uint32_t>;

Scene scene_of(Body body)
{
    Scene scene;
    scene.bodies.push_back(std::move(body));
    return scene;
}

/// 4 x 3 vertices.
Body small_grid()
{
    Body body;
    body.shape.cells = {3, 2};
    body.shape.size = {3, 2};
    return body;
}

Indices held(const Pin& pin, Body body = small_grid())
{
    body.pins = {pin};
    const Scene resolved = resolve(scene_of(body));
    return resolved.bodies[0].pins.empty() ? Indices{} : resolved.bodies[0].pins[0].vertices;
}

Pin corners(std::vector<std::string> names)
{
    Pin pin;
    pin.corners = std::move(names);
    return pin;
}

Pin edges(std::vector<std::string> names)
{
    Pin pin;
    pin.edges = std::move(names);
    return pin;
}

Pin box(glm::dvec3 low, glm::dvec3 high)
{
    Pin pin;
    pin.use_box = true;
    pin.box_min = low;
    pin.box_max = high;
    return pin;
}

Keyframe key(double time, glm::dvec3 translate, glm::dvec3 axis, double degrees, glm::dvec3 centre)
{
    return {time, translate, axis, degrees, centre};
}

void check_close(const glm::dvec3& a, const glm::dvec3& b)
{
    INFO(a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z);
    CHECK(glm::length(a - b) < 1e-12);
}

} // namespace

TEST_CASE("corners and edges of a grid are found by name")
{
    CHECK(held(corners({"top_left"})) == Indices{0});
    CHECK(held(corners({"top_right"})) == Indices{3});
    CHECK(held(corners({"bottom_left"})) == Indices{8});
    CHECK(held(corners({"bottom_right", "top_left"})) == Indices{0, 11});
    CHECK(held(edges({"top"})) == Indices{0, 1, 2, 3});
    CHECK(held(edges({"bottom"})) == Indices{8, 9, 10, 11});
    CHECK(held(edges({"left"})) == Indices{0, 4, 8});
    CHECK(held(edges({"right", "left"})) == Indices{0, 3, 4, 7, 8, 11});
    Body chain;
    chain.shape.kind = ShapeKind::chain;
    chain.shape.links = 4;
    CHECK(held(corners({"first"}), chain) == Indices{0});
    CHECK(held(corners({"last"}), chain) == Indices{4});
}

TEST_CASE("a pin box is in world space, after the transform and with its border")
{
    CHECK(held(box({-1.5, -1, 0}, {-0.5, 1, 0})) == Indices{0, 1, 4, 5, 8, 9});
    Body moved = small_grid();
    moved.transform.translate = {10, 0, 0};
    moved.transform.scale = 2;
    CHECK(held(box({7, -2, 0}, {7, 2, 0}), moved) == Indices{0, 4, 8});
}

TEST_CASE("a pin box looks at the start positions where they are given")
{
    Body body = small_grid();
    body.start_positions.assign(12, glm::dvec3(0));
    body.start_positions[7] = {100, 0, 0};
    CHECK(held(box({99, -1, -1}, {101, 1, 1}), body) == Indices{7});
}

TEST_CASE("a box that holds no vertex is a warning that names it")
{
    Body body = small_grid();
    body.pins = {corners({"top_left"}), box({50, 50, 50}, {51, 51, 51})};
    std::vector<SceneIssue> warnings;
    const Scene resolved = resolve(scene_of(body), &warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(!warnings[0].error);
    CHECK(warnings[0].field == "bodies[0].pins[1].box");
    CHECK_THAT(warnings[0].text, Contains("[50, 50, 50]"));
    CHECK(resolved.bodies[0].pins.size() == 1); // an empty pin is no pin
}

TEST_CASE("a vertex of two pins belongs to the first")
{
    Body body = small_grid();
    Pin first = corners({"top_left"}), second = edges({"top"});
    first.vertices = {0, 0, 1};
    first.motion = {key(0, {1, 0, 0}, {0, 1, 0}, 0, {})};
    body.pins = {first, second};
    const Scene resolved = resolve(scene_of(body));
    REQUIRE(resolved.bodies[0].pins.size() == 2);
    CHECK(resolved.bodies[0].pins[0].vertices == Indices{0, 1});
    CHECK(resolved.bodies[0].pins[0].motion.size() == 1);
    CHECK(resolved.bodies[0].pins[1].vertices == Indices{2, 3});
}

TEST_CASE("resolving twice is resolving once")
{
    Body body = small_grid();
    body.transform.rotate_degrees = 30;
    body.pins = {edges({"top"}), corners({"top_left"}), box({50, 50, 50}, {51, 51, 51})};
    const Scene once = resolve(scene_of(body));
    std::vector<SceneIssue> warnings;
    const Scene twice = resolve(once, &warnings);
    CHECK(warnings.empty());
    CHECK(twice.bodies[0].mesh.positions == once.bodies[0].mesh.positions);
    REQUIRE(twice.bodies[0].pins.size() == once.bodies[0].pins.size());
    CHECK(twice.bodies[0].pins[0].vertices == once.bodies[0].pins[0].vertices);
}

TEST_CASE("a transform scales, then turns, then moves")
{
    Body body;
    body.shape.cells = {1, 1};
    body.shape.size = {2, 2};
    body.transform.scale = 3;
    body.transform.rotate_axis = {0, 0, 5}; // any length
    body.transform.rotate_degrees = 90;
    body.transform.translate = {10, 0, 1};
    const Mesh mesh = resolve(scene_of(body)).bodies[0].mesh;
    check_close(mesh.positions[0], {10 - 3, -3, 1}); // (-1, 1) -> (-3, 3) -> (-3, -3) -> (7, -3)
    check_close(mesh.positions[1], {10 - 3, 3, 1});
    Body chain;
    chain.shape.kind = ShapeKind::chain;
    chain.transform.scale = 2;
    CHECK(resolve(scene_of(chain)).bodies[0].mesh.link_width == 0.02);
}

TEST_CASE("without a transform the mesh is untouched to the last bit")
{
    const Body body = small_grid();
    const Mesh mesh = make_grid(3, 2, 3, 2, true);
    CHECK(resolve(scene_of(body)).bodies[0].mesh.positions == mesh.positions);
}

TEST_CASE("a transform that leaves the range of numbers is refused")
{
    Body body = small_grid();
    body.transform.scale = 1e30;
    body.shape.size = {1e10, 1};
    CHECK_THROWS_WITH(resolve(scene_of(body)), Contains("bodies[0].transform is [-5e+39"));
}

TEST_CASE("a body whose size float cannot hold is refused, and one that it barely holds is warned of")
{
    const auto issue = [](double size, ShapeKind kind, const char* precision = "float") {
        Scene scene;
        Body body;
        body.shape.kind = kind;
        body.shape.box_size = glm::dvec3(size);
        body.shape.radius = size;
        body.shape.length = size;
        body.shape.size = glm::dvec2(size);
        body.material = is_solid(kind) ? solid_material() : Material{};
        scene.method.precision = option_named<Precision>(precision);
        scene.bodies = {body};
        std::vector<SceneIssue> found;
        try
        {
            resolve(scene, &found);
        }
        catch (const Error&)
        {}
        return found.empty() ? SceneIssue{} : found.front();
    };
    for (const double size : {1e-20, 1e-30, 1e25})
        for (const ShapeKind kind : {ShapeKind::box, ShapeKind::ball, ShapeKind::chain, ShapeKind::grid})
        {
            INFO(size << " m, shape " << static_cast<int>(kind));
            CHECK(issue(size, kind).error);
            CHECK_THAT(issue(size, kind).text, Contains("m would be right"));
            CHECK(issue(size, kind, "double").text.find("whose square") == std::string::npos);
        }
    CHECK(issue(1e-20, ShapeKind::box).field == "bodies[0].box.size");
    CHECK(issue(1e-30, ShapeKind::ball).field == "bodies[0].ball.radius");
    const SceneIssue cube = issue(1e-9, ShapeKind::box);
    CHECK_FALSE(cube.error);
    CHECK(cube.field == "bodies[0].box.size");
    CHECK_THAT(cube.text, Contains("2.1e-08 m and more are safe"));
    for (const ShapeKind kind : {ShapeKind::box, ShapeKind::ball, ShapeKind::chain, ShapeKind::grid})
        for (const double size : {1e-6, 1.0, 1e6})
            CHECK(issue(size, kind).text.empty());
}

TEST_CASE("a scene without bodies resolves") { CHECK(resolve(Scene{}).bodies.empty()); }

TEST_CASE("a mesh file is found beside the scene, checked and reported")
{
    const Temporary folder;
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 0 0 0\nv 0 0 1\nv 0 0 -1\n"
                          "f 1 2 3\nf 1 1 2\nf 5 6 2\nf 2 7 1\nf 2 3 1\n");
    const std::string head = R"({"taut": 1, "bodies": [{"mesh": "m.obj")";
    std::vector<SceneIssue> warnings;
    const Scene scene = resolve(load_scene(folder.write("s.json", head + "}]}")), &warnings);
    CHECK(scene.bodies[0].mesh.positions.size() == 5);
    CHECK(scene.bodies[0].mesh.triangles.size() == 3);
    REQUIRE(warnings.size() == 4);
    CHECK_THAT(warnings[0].text, Contains("1 triangles without area") && Contains("number 1 of the file"));
    CHECK_THAT(warnings[1].text, Contains("1 triangles of the same corners as an earlier one") &&
                                     Contains("number 4 of the file"));
    CHECK_THAT(warnings[2].text, Contains("1 vertices of no triangle"));
    CHECK_THAT(warnings[3].text,
               Contains("1 edges of more than two triangles") && Contains("joins vertices 0 and 1"));
    // Indices can be checked only now.
    CHECK_THROWS_WITH(
        resolve(load_scene(folder.write("s.json", head + R"(, "pins": [{"vertices": [5]}]}]})"))),
        Contains("bodies[0].pins[0].vertices[0] is 5; the body has 5 vertices"));
}

TEST_CASE("a missing mesh file is an io error that names the resolved path")
{
    const Temporary folder;
    const Scene scene =
        load_scene(folder.write("s.json", R"({"taut": 1, "bodies": [{"mesh": "sub/none.ply"}]})"));
    try
    {
        resolve(scene);
        FAIL("no error");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::io);
        CHECK_THAT(error.what(), Contains((folder.path / "sub" / "none.ply").string()));
    }
}

TEST_CASE("without keys, before the first and after the last the pose stands still")
{
    const glm::dvec3 rest(1, 2, 3);
    CHECK(pose({}, 5, rest) == rest);
    const std::vector<Keyframe> motion = {key(1, {1, 0, 0}, {0, 1, 0}, 0, {}),
                                          key(2, {3, 0, 0}, {0, 1, 0}, 0, {})};
    CHECK(pose(motion, -1, rest) == rest + glm::dvec3(1, 0, 0));
    CHECK(pose(motion, 1, rest) == rest + glm::dvec3(1, 0, 0));
    CHECK(pose(motion, 1.5, rest) == rest + glm::dvec3(2, 0, 0));
    CHECK(pose(motion, 2, rest) == rest + glm::dvec3(3, 0, 0));
    CHECK(pose(motion, 9, rest) == rest + glm::dvec3(3, 0, 0));
}

TEST_CASE("the angle is linear between keys, also over several turns")
{
    const std::vector<Keyframe> motion = {key(0, {}, {0, 0, 2}, 0, {1, 0, 0}),
                                          key(1, {}, {0, 0, 2}, 720, {1, 0, 0})};
    check_close(pose(motion, 0.125, {2, 0, 0}), {1, 1, 0});
    check_close(pose(motion, 0.25, {2, 0, 0}), {0, 0, 0});
    check_close(pose(motion, 0.75, {2, 0, 5}), {0, 0, 5});
    check_close(pose(motion, 1, {2, 0, 0}), {2, 0, 0});
}

TEST_CASE("a pose agrees with a quaternion of the mathematics library")
{
    const glm::dvec3 axis(1, -2, 0.5), centre(0.3, 0.1, -4), rest(2, 7, 1), translate(5, 6, 7);
    const auto q = glm::angleAxis(glm::radians(77.0), glm::normalize(axis));
    check_close(pose({key(0, translate, axis, 77, centre)}, 0, rest),
                q * (rest - centre) + centre + translate);
}

TEST_CASE("a key without rotation takes the axis of its neighbour")
{
    const std::vector<Keyframe> motion = {key(0, {}, {0, 1, 0}, 0, {}), key(1, {}, {0, 0, 1}, 90, {})};
    check_close(pose(motion, 0.5, {1, 0, 0}), {std::sqrt(0.5), std::sqrt(0.5), 0});
}

TEST_CASE("what turns about a point from or to a key without a turn stays there")
{
    const glm::dvec3 centre(3, -1, 2), rest = centre + glm::dvec3(1, 0, 0);
    const std::vector<Keyframe> motion = {key(0, {}, {0, 1, 0}, 0, {}), key(1, {}, {0, 0, 1}, 180, centre),
                                          key(2, {}, {0, 1, 0}, 0, {}),
                                          key(3, {0, 5, 0}, {0, 0, 1}, 90, {7, 0, 0})};
    check_close(pose(motion, 0.5, rest), centre + glm::dvec3(0, 1, 0));
    check_close(pose(motion, 1.5, rest), centre + glm::dvec3(0, 1, 0));
    check_close(pose(motion, 0.25, centre), centre);
    check_close(pose(motion, 2.5, {7, 0, 4}), {7, 2.5, 4});
}
