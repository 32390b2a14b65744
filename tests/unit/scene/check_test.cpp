#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/settings.hpp"

#include <functional>
#include <limits>

using namespace taut;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// A scene in which everything has a place that can be spoilt.
Scene good_scene()
{
    Scene scene;
    Body grid;
    grid.name = "grid";
    grid.shape.cells = {2, 2};
    grid.pins.push_back({});
    grid.pins[0].corners = {"top_left"};
    grid.pins[0].motion = {{}, {}};
    grid.pins[0].motion[1].time = 1;
    grid.springs.push_back({0, 8, 1, 0});
    grid.vertex_masses.assign(9, 0.1);
    grid.start_positions.assign(9, glm::dvec3(1));
    Body chain;
    chain.name = "chain";
    chain.shape.kind = ShapeKind::chain;
    chain.pins.push_back({});
    chain.pins[0].corners = {"first"};
    scene.bodies = {grid, chain};
    scene.colliders.resize(2);
    scene.colliders[0].kind = ColliderKind::plane;
    return scene;
}

struct Fault
{
    const char* field;
    std::function<void(Scene&)> spoil;
    ErrorCode code = ErrorCode::bad_input;
};

using S = Scene&;

const std::vector<Fault> kFaults = {
    {"taut", [](S s) { s.version = 2; }},
    {"timestep", [](S s) { s.timestep = 0; }, ErrorCode::bad_timestep},
    {"timestep", [](S s) { s.timestep = -1; }, ErrorCode::bad_timestep},
    {"timestep", [](S s) { s.timestep = kNan; }, ErrorCode::bad_timestep},
    {"timestep", [](S s) { s.timestep = 1e30; }, ErrorCode::bad_timestep},
    {"timestep", [](S s) { s.timestep = kInf; }, ErrorCode::bad_timestep},
    {"duration", [](S s) { s.duration = -1; }},
    {"duration", [](S s) { s.duration = kNan; }},
    {"duration", [](S s) { s.duration = 1e12; }},
    {"gravity", [](S s) { s.gravity.y = kInf; }},
    {"gravity", [](S s) { s.gravity.y = 1e31; }},
    {"damping", [](S s) { s.damping = -0.1; }},
    {"max_speed", [](S s) { s.max_speed = -1; }},
    {"depenetration_speed", [](S s) { s.depenetration_speed = kNan; }},
    {"method.type", [](S s) { s.method.type = static_cast<MethodKind>(7); }},
    {"method.substeps", [](S s) { s.method.substeps = 1001; }},
    {"method.iterations", [](S s) { s.method.iterations = 1001; }},
    {"method.precision", [](S s) { s.method.precision = static_cast<Precision>(2); }},
    {"method.volume", [](S s) { s.method.volume = -0.01; }},
    {"method.volume", [](S s) { s.method.volume = 1.01; }},
    {"method.volume", [](S s) { s.method.volume = kNan; }},
    {"method.activate_strain",
     [](S s) {
         s.method.compress = true;
         s.method.activate_strain = s.method.release_strain = 1;
     }},
    {"bodies[0].grid.cells",
     [](S s) {
         s.bodies[0] = {};
         s.bodies[0].shape.cells.x = 0;
     }},
    {"bodies[0].grid.cells",
     [](S s) {
         s.bodies[0] = {};
         s.bodies[0].shape.cells = {4294967295u, 4294967295u};
     }},
    {"bodies[0].grid.size", [](S s) { s.bodies[0].shape.size.y = 0; }},
    {"bodies[0].grid.size", [](S s) { s.bodies[0].shape.size.x = kNan; }},
    {"bodies[0].grid.diagonals", [](S s) { s.bodies[0].shape.diagonals = static_cast<Diagonals>(2); }},
    {"bodies[1].chain.links", [](S s) { s.bodies[1].shape.links = 4294967295u; }},
    {"bodies[1].chain.length", [](S s) { s.bodies[1].shape.length = 0; }},
    {"bodies[1].chain.width", [](S s) { s.bodies[1].shape.width = -1; }},
    {"bodies[1].mesh",
     [](S s) {
         s.bodies[1] = {};
         s.bodies[1].shape.kind = ShapeKind::mesh;
     }},
    {"bodies[0].material.density", [](S s) { s.bodies[0].material.density = 0; }},
    {"bodies[0].material.density", [](S s) { s.bodies[0].material.density = kNan; }},
    {"bodies[0].material.stretch_stiffness", [](S s) { s.bodies[0].material.stretch_stiffness = -1; }},
    {"bodies[0].material.stretch_stiffness", [](S s) { s.bodies[0].material.stretch_stiffness = kNan; }},
    {"bodies[0].material.stretch_stiffness", [](S s) { s.bodies[0].material.stretch_stiffness = -kInf; }},
    {"bodies[0].material.bending_stiffness", [](S s) { s.bodies[0].material.bending_stiffness = kInf; }},
    {"bodies[0].material.thickness", [](S s) { s.bodies[0].material.thickness = -1e-9; }},
    {"bodies[0].transform.scale", [](S s) { s.bodies[0].transform.scale = 0; }},
    {"bodies[0].transform.translate", [](S s) { s.bodies[0].transform.translate.z = kNan; }},
    {"bodies[0].transform.rotate.axis",
     [](S s) {
         s.bodies[0].transform.rotate_axis = {0, 0, 0};
         s.bodies[0].transform.rotate_degrees = 1;
     }},
    {"bodies[0].transform.rotate.degrees", [](S s) { s.bodies[0].transform.rotate_degrees = kNan; }},
    {"bodies[0].velocity", [](S s) { s.bodies[0].velocity.x = kInf; }},
    {"bodies[0].pins[0]", [](S s) { s.bodies[0].pins[0].corners.clear(); }},
    {"bodies[0].pins[0].corners[0]", [](S s) { s.bodies[0].pins[0].corners = {"topleft"}; }},
    {"bodies[0].pins[0].corners[0]", [](S s) { s.bodies[0].pins[0].corners = {"first"}; }},
    {"bodies[0].pins[0].edges[0]", [](S s) { s.bodies[0].pins[0].edges = {"up"}; }},
    {"bodies[1].pins[0].edges", [](S s) { s.bodies[1].pins[0].edges = {"top"}; }},
    {"bodies[1].pins[0].corners[0]", [](S s) { s.bodies[1].pins[0].corners = {"top_left"}; }},
    {"bodies[0].pins[0].vertices[1]",
     [](S s) {
         s.bodies[0].pins[0].vertices = {8, 9};
     }},
    {"bodies[0].pins[0].box",
     [](S s) {
         s.bodies[0].pins[0].use_box = true;
         s.bodies[0].pins[0].box_min.x = 1;
     }},
    {"bodies[0].pins[0].box.max",
     [](S s) {
         s.bodies[0].pins[0].use_box = true;
         s.bodies[0].pins[0].box_max.x = kNan;
     }},
    {"bodies[0].pins[0].motion[1].time", [](S s) { s.bodies[0].pins[0].motion[1].time = 0; }},
    {"bodies[0].pins[0].motion[0].time",
     [](S s) {
         s.bodies[0].pins[0].motion[0].time = kNan;
         s.bodies[0].pins[0].motion.resize(1);
     }},
    {"bodies[0].pins[0].motion[1].translate", [](S s) { s.bodies[0].pins[0].motion[1].translate.y = kNan; }},
    {"bodies[0].pins[0].motion[1].rotate.axis",
     [](S s) {
         s.bodies[0].pins[0].motion[1].rotate_axis = {};
         s.bodies[0].pins[0].motion[1].rotate_degrees = 9;
     }},
    {"bodies[0].springs[0]", [](S s) { s.bodies[0].springs[0].b = 0; }},
    {"bodies[0].springs[0].b", [](S s) { s.bodies[0].springs[0].b = 9; }},
    {"bodies[0].springs[0].rest_length", [](S s) { s.bodies[0].springs[0].rest_length = kNan; }},
    {"bodies[0].springs[0].rest_length", [](S s) { s.bodies[0].springs[0].rest_length = -1; }},
    {"bodies[0].springs[0].compliance", [](S s) { s.bodies[0].springs[0].compliance = -1; }},
    {"bodies[0].vertex_masses", [](S s) { s.bodies[0].vertex_masses.pop_back(); }},
    {"bodies[0].vertex_masses[3]", [](S s) { s.bodies[0].vertex_masses[3] = 0; }},
    {"bodies[0].start_positions", [](S s) { s.bodies[0].start_positions.pop_back(); }},
    {"bodies[0].start_positions[4]", [](S s) { s.bodies[0].start_positions[4].y = kNan; }},
    {"colliders[0].plane.normal",
     [](S s) {
         s.colliders[0].normal = {0, 0, 0};
     }},
    {"colliders[0].plane.point", [](S s) { s.colliders[0].point.x = kNan; }},
    {"colliders[1].sphere.radius", [](S s) { s.colliders[1].radius = 0; }},
    {"colliders[1].sphere.centre", [](S s) { s.colliders[1].point.x = kInf; }},
    {"colliders[1].friction", [](S s) { s.colliders[1].friction = -0.5; }},
    {"colliders[1].motion[1].time", [](S s) { s.colliders[1].motion.resize(2); }},
};

} // namespace

TEST_CASE("a good scene has no issue")
{
    CHECK(check(good_scene()).empty());
    CHECK(!any_error(check(Scene{}))); // no bodies at all is a scene, too
    Scene extreme = good_scene();
    extreme.bodies[0].material.stretch_stiffness = kInf;
    extreme.bodies[0].vertex_masses[0] = 1e-12;
    extreme.bodies[0].vertex_masses[1] = 1e12;
    extreme.bodies[0].springs[0].rest_length = 0;
    extreme.timestep = 1;
    extreme.duration = 0;
    extreme.bodies[1].shape.links = 0;
    CHECK(check(extreme).empty());
}

TEST_CASE("every fault is one issue that names its field")
{
    for (const Fault& fault : kFaults)
    {
        INFO(fault.field);
        Scene scene = good_scene();
        fault.spoil(scene);
        const std::vector<SceneIssue> issues = check(scene);
        REQUIRE(issues.size() == 1);
        CHECK(issues[0].error);
        CHECK(issues[0].field == fault.field);
        CHECK(issues[0].code == fault.code);
        CHECK(!issues[0].text.empty());
    }
}

TEST_CASE("resolve throws the first issue with its code, and counts the others")
{
    for (const Fault& fault : kFaults)
    {
        INFO(fault.field);
        Scene scene = good_scene();
        fault.spoil(scene);
        try
        {
            resolve(scene);
            FAIL("no error");
        }
        catch (const Error& error)
        {
            CHECK(error.code() == fault.code);
            CHECK(std::string(error.what()).starts_with(std::string(fault.field) + ' '));
        }
    }
    Scene scene = good_scene();
    scene.damping = -1;
    scene.method.substeps = 1001;
    scene.timestep = 0;
    CHECK_THROWS_WITH(resolve(scene),
                      "timestep is 0 s; it must be greater than 0 s and at most 1 s (and 2 other errors)");
}

TEST_CASE("a time step too short is told without substeps that nobody asked for")
{
    Scene scene = good_scene();
    scene.timestep = 1e-18;
    scene.method.substeps = 0; // automatic
    REQUIRE(check(scene).size() >= 1);
    CHECK(check(scene)[0].text == "is 1e-18 s; a substep, and so a time step, must be at least 1e-15 s");
    scene.method.substeps = 4;
    CHECK_THAT(check(scene)[0].text, Contains("in 4 substeps; a substep must be"));
}

TEST_CASE("an unknown word names the nearest known one, a value that is none of an option's the words")
{
    Scene scene = good_scene();
    scene.method.type = static_cast<MethodKind>(7);
    scene.method.precision = static_cast<Precision>(2);
    scene.bodies[0].pins[0].corners = {"topleft"};
    const auto issues = check(scene);
    REQUIRE(issues.size() == 3);
    CHECK_THAT(issues[0].text, Contains("is value 7; it must be \"mass_spring\", "));
    CHECK(issues[1].text == "is value 2; it must be \"float\" or \"double\"");
    CHECK_THAT(issues[2].text, Contains("did you mean \"top_left\"?"));
}

TEST_CASE("a spring that is to become a constraint when it is pressed has a length to be pressed to")
{
    Scene scene = good_scene();
    scene.method.activate_strain = 1.5;
    CHECK(check(scene).empty());
    scene.method.compress = true;
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].field == "method.activate_strain");
    CHECK_THAT(issues[0].text, Contains("is 1.5; with compress it must be below 1"));
}

TEST_CASE("a preconditioner that is made of the matrix takes one that is assembled")
{
    Scene scene = good_scene();
    scene.method.type = MethodKind::implicit_euler;
    scene.method.preconditioner = NewtonPreconditioner::two_level;
    const auto errors = [&scene] {
        std::vector<SceneIssue> out = check(scene);
        std::erase_if(out, [](const SceneIssue& issue) { return issue.field != "method.preconditioner"; });
        return out;
    };
    CHECK(errors().empty());
    scene.method.linear_operator = LinearOperator::matrix_free;
    REQUIRE(errors().size() == 1);
    CHECK_THAT(errors()[0].text, Contains("take linear_operator \"assembled\""));
}

TEST_CASE("a wind that nothing catches is a warning")
{
    Scene scene = good_scene();
    scene.wind.density = 1.2;
    CHECK(check(scene).empty());
    scene.wind.velocity = {3, 0, 0};
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK_THAT(issues[0].text, Contains("no material has \"drag\""));
    scene.bodies[0].material.drag = 1;
    CHECK(check(scene).empty());
}

TEST_CASE("drag without air is a warning")
{
    Scene scene = good_scene();
    scene.bodies[0].material.drag = 1;
    scene.wind.density = 0;
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK(issues[0].field == "bodies[0].material.drag");
    scene.wind.density = 1.2; // at rest
    CHECK(check(scene).empty());
}

TEST_CASE("two bodies of one name are a warning")
{
    Scene scene = good_scene();
    scene.bodies[1].name = "grid";
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK(issues[0].field == "bodies[1].name");
    std::vector<SceneIssue> warnings;
    resolve(scene, &warnings);
    CHECK(warnings.size() == 1);
}

TEST_CASE("a group that no body has is refused by name, and so are more of them than can be told apart")
{
    Scene scene = good_scene();
    scene.bodies[0].contact.group = "skirt";
    scene.bodies[1].contact.passes = {"skirt", "default"};
    CHECK(check(scene).empty());
    scene.bodies[1].contact.passes = {"skirt", "skrit"};
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].error);
    CHECK(issues[0].field == "bodies[1].contact.passes[1]");
    CHECK_THAT(issues[0].text, Contains("is \"skrit\"; it must be \"skirt\" or \"default\"") &&
                                   Contains("did you mean \"skirt\""));
    scene.bodies[1].contact.passes.clear();
    for (int k = 0; k < 31; ++k)
    {
        scene.bodies.push_back(scene.bodies[1]);
        scene.bodies.back().name = scene.bodies.back().contact.group = "body " + std::to_string(k);
    }
    REQUIRE(check(scene).size() == 1);
    CHECK_THAT(check(scene)[0].text, Contains("33 different contact.group; at most 32"));
    scene.bodies.pop_back();
    CHECK(check(scene).empty());
}

TEST_CASE("a led mesh that all others pass through is warned of")
{
    Scene scene = good_scene();
    scene.bodies.resize(1);
    scene.bodies[0].name = "cloth";
    scene.contact.between = true;
    Body wall;
    wall.kinematic.used = true;
    scene.bodies.push_back(wall);
    CHECK(check(scene).empty());
    scene.bodies[0].contact.group = "cloth";
    scene.bodies[1].contact.passes = {"cloth"};
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK(issues[0].field == "bodies[1].kinematic");
    CHECK_THAT(issues[0].text, Contains("meets nothing") && Contains("passes through all other bodies"));
}

TEST_CASE("contact that lets nothing meet is warned of")
{
    Scene scene = good_scene();
    scene.bodies.resize(1);
    scene.contact.between = true;
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK(issues[0].field == "contact");
    CHECK_THAT(issues[0].text, Contains("does nothing") && Contains("self"));
    scene.bodies[0].contact.self = true;
    CHECK(check(scene).empty());
    scene.bodies[0].contact = {.group = "a", .passes = {"a"}};
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].name = "other";
    REQUIRE(check(scene).size() == 1);
    CHECK_THAT(check(scene)[0].text, Contains("pass through each other"));
}
