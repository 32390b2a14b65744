#include "support/catch.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/scene.hpp"

#include <limits>

using namespace taut;

namespace {

/// A scene with one more member.
Scene with(const std::string& member) { return parse_scene("{\"taut\": 1, " + member + "}"); }

Body body(const std::string& members) { return with("\"bodies\": [{" + members + "}]").bodies.at(0); }

std::string refusal(const std::string& json)
{
    try
    {
        parse_scene(json, {}, "my.json");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "accepted";
}

std::string refusal_of(const std::string& member) { return refusal("{\"taut\": 1, " + member + "}"); }

std::string refusal_of_body(const std::string& members)
{
    return refusal_of("\"bodies\": [{" + members + "}]");
}

} // namespace

TEST_CASE("a file that says nothing has the defaults of the types")
{
    const Scene read = parse_scene("{\"taut\": 1}");
    const Scene plain;
    CHECK(read.timestep == plain.timestep);
    CHECK(read.duration == plain.duration);
    CHECK(read.gravity == plain.gravity);
    CHECK(read.method.type == plain.method.type);
    CHECK(read.method.substeps == plain.method.substeps);
    CHECK(read.method.precision == plain.method.precision);
    CHECK(read.bodies.empty());
    const Body default_body = body("\"grid\": {}");
    CHECK(default_body.shape.cells == Shape().cells);
    CHECK(default_body.shape.diagonals == Shape().diagonals);
    CHECK(default_body.material.stretch_stiffness == Material().stretch_stiffness);
    CHECK(default_body.transform.scale == 1);
}

TEST_CASE("every value of a scene file arrives in its place")
{
    const Scene scene =
        with(R"("name": "n", "timestep": 0.25, "duration": 2, "gravity": [1, 2, 3], "damping": 4,
        "max_speed": 5, "depenetration_speed": 6, "external_forces": true,
        "method": {"type": "xpbd", "substeps": 7, "iterations": 8, "precision": "double"})");
    CHECK(scene.name == "n");
    CHECK(scene.timestep == 0.25);
    CHECK(scene.duration == 2);
    CHECK(scene.gravity == glm::dvec3(1, 2, 3));
    CHECK(scene.damping == 4);
    CHECK(scene.max_speed == 5);
    CHECK(scene.depenetration_speed == 6);
    CHECK(scene.external_forces);
    CHECK(scene.method.substeps == 7);
    CHECK(scene.method.iterations == 8);
    CHECK(scene.method.precision == Precision::float64);
}

TEST_CASE("every value of a body arrives in its place")
{
    const Body b = body(R"("name": "b", "grid": {"cells": [2, 3], "size": [4, 5], "diagonals": "uniform"},
        "material": {"density": 1, "stretch_stiffness": "rigid", "bending_stiffness": 2, "thickness": 3},
        "transform": {"translate": [1, 2, 3], "rotate": {"axis": [0, 0, 1], "degrees": 45}, "scale": 6},
        "velocity": [7, 8, 9],
        "pins": [{"vertices": [1, 2], "box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "corner": "top_left",
                  "corners": ["top_right"], "edge": "left", "edges": ["right", "top"],
                  "motion": [{"time": 1, "translate": [1, 0, 0],
                              "rotate": {"axis": [1, 0, 0], "degrees": 30, "centre": [4, 5, 6]}}]}],
        "springs": [{"a": 1, "b": 2, "rest_length": 0.5, "compliance": 0.25}],
        "vertex_masses": [1, 2], "start_positions": [[1, 2, 3]])");
    CHECK(b.name == "b");
    CHECK(b.shape.kind == ShapeKind::grid);
    CHECK(b.shape.cells == glm::uvec2(2, 3));
    CHECK(b.shape.size == glm::dvec2(4, 5));
    CHECK(b.shape.diagonals == Diagonals::uniform);
    CHECK(b.material.density == 1);
    CHECK(b.material.stretch_stiffness == std::numeric_limits<double>::infinity());
    CHECK(b.material.bending_stiffness == 2);
    CHECK(b.material.thickness == 3);
    CHECK(b.transform.translate == glm::dvec3(1, 2, 3));
    CHECK(b.transform.rotate_axis == glm::dvec3(0, 0, 1));
    CHECK(b.transform.rotate_degrees == 45);
    CHECK(b.transform.scale == 6);
    CHECK(b.velocity == glm::dvec3(7, 8, 9));
    REQUIRE(b.pins.size() == 1);
    CHECK(b.pins[0].vertices == std::vector<std::uint32_t>{1, 2});
    CHECK(b.pins[0].use_box);
    CHECK(b.pins[0].box_max == glm::dvec3(1));
    CHECK(b.pins[0].corners == std::vector<std::string>{"top_left", "top_right"});
    CHECK(b.pins[0].edges == std::vector<std::string>{"left", "right", "top"});
    REQUIRE(b.pins[0].motion.size() == 1);
    CHECK(b.pins[0].motion[0].time == 1);
    CHECK(b.pins[0].motion[0].rotate_degrees == 30);
    CHECK(b.pins[0].motion[0].rotate_centre == glm::dvec3(4, 5, 6));
    REQUIRE(b.springs.size() == 1);
    CHECK(b.springs[0].b == 2);
    CHECK(b.springs[0].compliance == 0.25);
    CHECK(b.vertex_masses == std::vector<double>{1, 2});
    CHECK(b.start_positions == std::vector<glm::dvec3>{{1, 2, 3}});
}

TEST_CASE("chains, mesh files and colliders arrive in their places")
{
    const Body chain = body(R"("chain": {"links": 3, "length": 2, "width": 0.5})");
    CHECK(chain.shape.kind == ShapeKind::chain);
    CHECK(chain.shape.links == 3);
    CHECK(chain.shape.length == 2);
    CHECK(chain.shape.width == 0.5);
    const Body mesh = body(R"("mesh": "skirt.obj", "weld_distance": 0.1)");
    CHECK(mesh.shape.kind == ShapeKind::mesh);
    CHECK(mesh.shape.file == "skirt.obj");
    CHECK(mesh.shape.weld_distance == 0.1);
    const Scene scene = with(R"("colliders": [
        {"name": "p", "plane": {"point": [1, 2, 3], "normal": [0, 0, 1]}, "friction": 0.5},
        {"sphere": {"centre": [4, 5, 6], "radius": 7}, "motion": [{"time": 0}, {"time": 1}]}])");
    REQUIRE(scene.colliders.size() == 2);
    CHECK(scene.colliders[0].kind == ColliderKind::plane);
    CHECK(scene.colliders[0].point == glm::dvec3(1, 2, 3));
    CHECK(scene.colliders[0].normal == glm::dvec3(0, 0, 1));
    CHECK(scene.colliders[0].friction == 0.5);
    CHECK(scene.colliders[1].kind == ColliderKind::sphere);
    CHECK(scene.colliders[1].point == glm::dvec3(4, 5, 6));
    CHECK(scene.colliders[1].radius == 7);
    CHECK(scene.colliders[1].motion.size() == 2);
}

TEST_CASE("a wrong type is refused by file, field, what is there and what would be right")
{
    CHECK(refusal_of("\"timestep\": \"fast\"") == "my.json: timestep is \"fast\"; it must be a number");
    CHECK(refusal_of("\"gravity\": [0, 1]") ==
          "my.json: gravity is a list of 2; it must be three numbers [x, y, z]");
    CHECK(refusal_of("\"gravity\": [0, 1, null]") == "my.json: gravity[2] is null; it must be a number");
    CHECK(refusal_of("\"method\": {\"substeps\": 2.5}") ==
          "my.json: method.substeps is 2.5; it must be a whole number from 1 to 1000, or \"automatic\"");
    CHECK(refusal_of("\"method\": {\"iterations\": 1.5}") ==
          "my.json: method.iterations is 1.5; it must be a whole number from 1 to 1000, or \"automatic\"");
    CHECK(refusal_of("\"method\": {\"linear_iterations\": -1}") ==
          "my.json: method.linear_iterations is -1; it must be a whole number from 1 to 100000");
    CHECK_THAT(refusal_of("\"method\": {\"substeps\": -1}"), Contains("is -1; it must be a whole number"));
    CHECK_THAT(refusal_of("\"method\": {\"substeps\": 4294967296}"), Contains("whole number"));
    CHECK_THAT(refusal_of_body("\"grid\": {\"cells\": [4.5, 4]}"),
               Contains("cells[0] is 4.5; it must be a whole number, 1 or more"));
    CHECK_THAT(refusal_of("\"external_forces\": 1"), Contains("must be true or false"));
    CHECK(refusal_of("\"method\": {\"compress\": 1}") ==
          "my.json: method.compress is 1; it must be true or false");
    CHECK_THAT(refusal_of("\"name\": 1"), Contains("must be a text in quotes"));
    CHECK_THAT(refusal_of("\"bodies\": {}"), Contains("bodies is an object; it must be a list"));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"material\": {\"density\": []}"),
               Contains("bodies[0].material.density is a list of 0; it must be a number"));
    CHECK_THAT(
        refusal_of_body("\"grid\": {}, \"material\": {\"stretch_stiffness\": \"stiff\"}"),
        Contains(
            "bodies[0].material.stretch_stiffness is \"stiff\"; it must be a number in N/m or \"rigid\""));
    CHECK_THAT(refusal_of_body("\"grid\": {\"cells\": [1]}"),
               Contains("bodies[0].grid.cells is a list of 1; it must be two"));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"pins\": [{\"vertices\": [0, -1]}]"),
               Contains("bodies[0].pins[0].vertices[1] is -1"));
    CHECK_THAT(refusal("[]"), Contains("my.json: the scene is a list of 0; it must be an object"));
}

TEST_CASE("an unknown key is refused with the nearest known one")
{
    CHECK(refusal_of("\"timestpe\": 1") ==
          "my.json: the scene has the unknown key \"timestpe\"; did you mean \"timestep\"?");
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"material\": {\"densty\": 1}"),
               Contains("bodies[0].material has the unknown key \"densty\"; did you mean \"density\"?"));
    CHECK_THAT(
        refusal_of_body(
            "\"grid\": {}, \"pins\": [{\"motion\": [{\"time\": 0, \"rotate\": {\"center\": [0,0,0]}}]}]"),
        Contains(
            "bodies[0].pins[0].motion[0].rotate has the unknown key \"center\"; did you mean \"centre\"?"));
    CHECK_THAT(refusal_of("\"qqqqqqqq\": 1"), Contains("it may have \"taut\", \"name\""));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"material\": {\"youngs_modulus\": 1}"),
               Contains("unknown key \"youngs_modulus\"; cloth is as stiff as \"stretch_stiffness\""));
    CHECK_THAT(refusal_of_body("\"box\": {}, \"material\": {\"stretch_stiffness\": 1}"),
               Contains("unknown key \"stretch_stiffness\"; a solid is as stiff as \"youngs_modulus\""));
}

TEST_CASE("an unknown word of an option is refused with all that there are, and the nearest")
{
    CHECK(refusal_of("\"method\": {\"type\": \"xpdb\"}") ==
          "my.json: method.type is \"xpdb\"; it must be \"mass_spring\", \"implicit_euler\", "
          "\"implicit_constraints\", \"acad\", \"pbd\", \"xpbd\" or \"vbd\" (did you mean \"xpbd\"?)");
    CHECK_THAT(refusal_of("\"method\": {\"precision\": \"flaot\"}"),
               Contains("method.precision is \"flaot\"; it must be \"float\" or \"double\" (did you mean "
                        "\"float\"?)"));
    CHECK_THAT(refusal_of("\"method\": {\"type\": \"implicit_euler\", \"preconditioner\": \"jacobi\"}"),
               Contains("\"block_jacobi\" or \"two_level\""));
    CHECK_THAT(refusal_of("\"method\": {\"type\": 6}"),
               Contains("method.type is 6; it must be a text in quotes"));
    CHECK_THAT(refusal_of_body("\"grid\": {\"diagonals\": \"both\"}"),
               Contains("bodies[0].grid.diagonals is \"both\""));
}

TEST_CASE("a number that may be missing has a word for that")
{
    const auto slack = [](const std::string& value) {
        return parse_scene(R"({"taut": 1, "bodies": [{"grid": {}, "material": {"attachment_slack": )" +
                           value + "}}]}")
            .bodies[0]
            .material.attachment_slack;
    };
    CHECK(slack("0.25") == 0.25);
    CHECK(slack("0") == 0.0);
    CHECK(!slack("\"none\"").has_value());
    CHECK_THROWS_WITH(slack("\"tight\""),
                      Contains("is \"tight\"; it must be a number (of the rest distance) or \"none\""));
    CHECK_THROWS_WITH(slack("-1"),
                      Contains("is -1; it must be 0 or more (of the rest distance), or \"none\""));
}

TEST_CASE("a missing or doubled choice is refused")
{
    CHECK(refusal("{}") ==
          "my.json: the scene lacks the key \"taut\"; write \"taut\": 1, the version of the format");
    CHECK(refusal("{\"taut\": 2}") == "my.json: taut is 2; this library reads version 1");
    CHECK_THAT(refusal_of_body("\"name\": \"x\""),
               Contains("bodies[0] needs one of \"grid\", \"chain\", \"mesh\", \"box\", \"ball\" or"));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"mesh\": \"a.obj\""),
               Contains("bodies[0] has both \"grid\" and \"mesh\""));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"weld_distance\": 0"),
               Contains("weld_distance stands beside \"grid\""));
    CHECK_THAT(refusal_of("\"colliders\": [{}]"), Contains("colliders[0] needs one of \"plane\", \"sphere\", "
                                                           "\"capsule\", \"cuboid\" or \"distance_field\""));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"springs\": [{\"a\": 0, \"b\": 1}]"),
               Contains("bodies[0].springs[0] lacks the key \"rest_length\""));
    CHECK_THAT(refusal_of_body("\"grid\": {}, \"pins\": [{\"box\": {\"min\": [0,0,0]}}]"),
               Contains("bodies[0].pins[0].box lacks the key \"max\""));
}

TEST_CASE("a key that stands twice in one object is refused, in two objects not")
{
    CHECK(refusal("{\"taut\": 1, \"taut\": 1}") ==
          "my.json: the key \"taut\" stands twice in the scene; keep one of the two");
    CHECK_THAT(refusal_of("\"bodies\": [{\"grid\": {}}, {\"grid\": {\"size\": [1, 1], \"size\": [1, 1]}}]"),
               Contains("the key \"size\" stands twice in bodies[1].grid;"));
    CHECK(with("\"bodies\": [{\"grid\": {}}, {\"grid\": {}}]").bodies.size() == 2);
}

TEST_CASE("text that is not JSON is refused with line and column")
{
    CHECK_THAT(refusal("{\n  \"taut\": 1,\n  \"name\": oops\n}"),
               Contains("my.json: line 3, column 11 is not JSON"));
    CHECK_THAT(refusal("{\"taut\": 1"), Contains("line 1, column 11 is not JSON"));
    CHECK_THAT(refusal(""), Contains("line 1, column 1 is not JSON"));
    CHECK_THAT(refusal("{\"taut\": 1} x"), Contains("line 1, column 13"));
    CHECK_THAT(refusal("{\"taut\": 1,\n\"damping\": 1e999}"), Contains("line 2, column 12: number overflow"));
    CHECK_THAT(refusal("{\"taut\": NaN}"), Contains("line 1, column 10"));
    CHECK_THAT(refusal("{\"taut\": 1, \"name\": \"\xff\"}"), Contains("not JSON"));
    CHECK_THAT(refusal(std::string(100000, '[')), Contains("nested more than 32 levels deep"));
}

TEST_CASE("a loaded scene knows its folder and has the file's name if it has none of its own")
{
    const Temporary folder;
    const Scene scene = load_scene(folder.write("flag.json", "{\"taut\": 1}"));
    CHECK(scene.name == "flag");
    CHECK(scene.directory == folder.path);
    CHECK(load_scene(folder.write("b.json", "{\"taut\": 1, \"name\": \"own\"}")).name == "own");
    try
    {
        load_scene(folder.path / "missing.json");
        FAIL("no error");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::io);
        CHECK_THAT(error.what(), Contains("missing.json: there is no such file"));
    }
}

TEST_CASE("the nearest word counts edits and gives up on strangers")
{
    constexpr std::array<std::string_view, 3> words = {"timestep", "duration", "damping"};
    CHECK(scene_file::nearest("timstep", words) == "timestep");
    CHECK(scene_file::nearest("time_step", words) == "timestep");
    CHECK(scene_file::nearest("dmaping", words) == "damping");
    CHECK(scene_file::nearest("xyz", words).empty());
    CHECK(scene_file::nearest(std::string(100000, 'a'), words).empty());
}
