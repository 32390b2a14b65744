#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/sphere.hpp"
#include "unit/scene/temporary.hpp"

using namespace taut;

TEST_CASE("methods that sweep take the substeps that mesh and weight ask for, others ten", "[substeps]")
{
    Scene scene = test::hanging(32);
    const auto substeps = [&](const char* method) {
        scene.method.type = option_named<MethodKind>(method);
        scene.method.substeps = 0;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t sweeps = substeps("xpbd");
    CHECK(sweeps > 40);
    const std::uint32_t waves = substeps("vbd"); // run further than weight is carried
    CHECK(waves > 1.5 * sweeps);
    CHECK(substeps("pbd") == sweeps);
    CHECK(substeps("implicit_euler") == 10);
    CHECK(substeps("mass_spring") == 10);
    scene.method.iterations = 4;
    CHECK(substeps("vbd") <= waves / 2 + 1);
}

TEST_CASE("what pins on all sides carry takes more substeps than what hangs from an edge", "[substeps]")
{
    Scene scene = test::hanging(12);
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    const std::uint32_t hanging = resolve(scene).method.substeps;
    Body& body = scene.bodies[0];
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.pins[0].corners = {"top_left", "top_right", "bottom_left", "bottom_right"};
    CHECK(resolve(scene).method.substeps > 2 * hanging);
    scene.gravity = {0, 0, -9.81}; // within the cloth: it hangs from two of them
    CHECK(resolve(scene).method.substeps <= 2 * hanging);
}

TEST_CASE("cloth that begins beside its pins takes more substeps than cloth that hangs from them",
          "[substeps]")
{
    Scene scene = test::hanging(20);
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    scene.bodies[0].pins = {Pin{}};
    const auto substeps = [&](const char* edge) {
        scene.bodies[0].pins[0].edges = {edge};
        return resolve(scene).method.substeps;
    };
    // A pendulum pulls with 3 - 2 cos a times its weight at the lowest point: with 1, 3 and 5.
    const double hangs = substeps("top"), flag = substeps("left"), falls_over = substeps("bottom");
    CHECK(flag == Approx(std::sqrt(3.0) * hangs).epsilon(0.1));
    CHECK(falls_over == Approx(std::sqrt(5.0) * hangs).epsilon(0.1));
}

TEST_CASE("a held solid takes what its stiffness asks for, up to where nobody sees it sag", "[substeps]")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {10, 2, 2};
    body.shape.box_size = {0.5, 0.1, 0.1};
    body.material.density = 1000;
    Pin pin;
    pin.faces = {"left"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    const auto substeps = [&](double modulus) {
        scene.bodies[0].material.youngs_modulus = modulus;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t soft = substeps(1e5), middle = substeps(1e6), stiff = substeps(1e7);
    CHECK(soft < middle);
    CHECK(middle < stiff);
    CHECK(substeps(1e10) < 2 * stiff);
    scene.bodies[0].pins.clear();
    CHECK(substeps(1e10) == 10);
}

TEST_CASE("under vbd held cloth takes the substeps that its waves ask for", "[substeps]")
{
    Scene scene = test::hanging(12);
    scene.method.substeps = 0;
    const auto substeps = [&](const char* method, double stiffness) {
        scene.method.type = option_named<MethodKind>(method);
        scene.bodies[0].material.stretch_stiffness = stiffness;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t soft = substeps("vbd", 1e3), stiff = substeps("vbd", 1e5);
    CHECK(stiff == Approx(10 * soft).margin(10)); // as the root of the stiffness
    CHECK(substeps("xpbd", 1e3) == substeps("xpbd", 1e5));
    scene.method.iterations = 4;
    CHECK(substeps("vbd", 1e5) == Approx(stiff / 2.0).margin(1));
    scene.bodies[0].pins.clear();
    CHECK(substeps("vbd", 1e5) < stiff / 4);
}

TEST_CASE("the waves of a network go by its own springs", "[substeps]")
{
    Scene scene = test::hanging(12);
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = 0;
    const auto substeps = [&](double edges, const SpringNetwork& network) {
        scene.bodies[0].material.stretch_stiffness = edges;
        scene.bodies[0].shape.network = network;
        return resolve(scene).method.substeps;
    };
    const double stiff = substeps(1e5, {});
    const double along = substeps(1e3, {.used = true, .structural = 1e5, .shear = 0});
    CHECK(along == Approx(stiff).epsilon(0.1)); // whose mean edge has diagonals in it
    CHECK(substeps(1e3, {.used = true, .structural = 5e4, .shear = 5e4}) == Approx(stiff).epsilon(0.1));
    const auto bends = [&](double bend) {
        return substeps(1e3, {.used = true, .structural = 0, .shear = 0, .bend = bend});
    };
    CHECK(bends(1e5) == Approx(2 * bends(2.5e4)).epsilon(0.05));
    CHECK(bends(2.5e4) > 0.7 * along); // of as much stiffness, and a longer mean edge
    CHECK(substeps(1e5, {.used = true, .structural = 1e3, .shear = 0}) < stiff / 4);
}

TEST_CASE("plastic cloth that its pins draw takes substeps by its stiffness under xpbd", "[substeps]")
{
    Scene scene = test::hanging(12);
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    scene.bodies[0].material.stretch_stiffness = 1e4;
    const std::uint32_t elastic = resolve(scene).method.substeps;
    scene.bodies[0].material.plastic_yield = 0.02;
    CHECK(resolve(scene).method.substeps == elastic); // nothing draws it
    Keyframe start, end;
    end.time = 1;
    end.translate = {0, 0.1, 0};
    scene.bodies[0].pins[0].motion = {start, end};
    const std::uint32_t drawn = resolve(scene).method.substeps;
    CHECK(drawn > 2 * elastic);
    scene.bodies[0].material.stretch_stiffness = 1.6e5;
    CHECK(resolve(scene).method.substeps == Approx(4 * drawn).margin(4)); // as the root of the stiffness
}

TEST_CASE("a gas asks for substeps, also without gravity", "[substeps]")
{
    Scene scene;
    Body ball;
    ball.shape.kind = ShapeKind::mesh;
    const Temporary folder;
    ball.shape.file = folder.path / "ball.obj";
    write_obj(ball.shape.file, test::sphere_mesh(4, 0.5));
    scene.bodies = {ball};
    scene.gravity = glm::dvec3(0);
    scene.method.substeps = 0;
    const auto substeps = [&](double pressure) {
        scene.bodies[0].material.pressure = pressure;
        return resolve(scene).method.substeps;
    };
    CHECK(substeps(1) == 10);
    const double strong = substeps(1000);
    CHECK(strong > 20);
    CHECK(substeps(4000) == Approx(2 * strong).margin(2));
    const double drawn_in = substeps(-20); // edges that are pressed together buckle where they act softer
    CHECK(drawn_in > 30);
    CHECK(substeps(-40) == drawn_in);
    CHECK(substeps(-1e-3) == 10); // not by so little
    scene.method.type = MethodKind::pbd;
    CHECK(substeps(-1000) == strong);
    scene.method.type = MethodKind::implicit_euler;
    CHECK(substeps(1000) == 10);
}

TEST_CASE("a mesh that is led asks for no substeps", "[substeps]")
{
    Scene scene;
    Body led;
    led.shape.cells = {64, 3};
    led.shape.size = {0.1, 0.1};
    led.kinematic.used = true;
    Body cloth;
    cloth.shape.cells = {4, 4};
    cloth.transform.translate = {0, 0, 1};
    scene.bodies = {cloth, led};
    scene.contact.between = true;
    scene.method.type = MethodKind::xpbd;
    CHECK(resolve(scene).method.substeps == 10);
}

TEST_CASE("where contacts come after the solve a ball takes more substeps on a floor", "[substeps]")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::ball;
    body.shape.radius = 0.05;
    body.material = solid_material();
    body.material.youngs_modulus = 1e8;
    scene.bodies = {body};
    scene.method.substeps = 0;
    Collider floor;
    floor.kind = ColliderKind::plane;
    const auto substeps = [&](const char* method, const std::vector<Collider>& colliders) {
        scene.method.type = option_named<MethodKind>(method);
        scene.colliders = colliders;
        return resolve(scene).method.substeps;
    };
    const std::uint32_t swept = substeps("xpbd", {floor});
    CHECK(substeps("xpbd", {}) < swept / 2);
    CHECK(substeps("implicit_euler", {}) == 10);
    CHECK(substeps("implicit_euler", {floor}) == swept);
    CHECK(substeps("vbd", {floor}) == swept);
    scene.method.iterations = 4; // contacts come once a substep all the same
    CHECK(substeps("vbd", {floor}) == swept);
    CHECK(substeps("xpbd", {floor}) < swept);
}

TEST_CASE("a free solid that stands on a point takes more substeps than one on a face", "[substeps]")
{
    Scene scene;
    scene.bodies.resize(1);
    Body& body = scene.bodies[0];
    body.shape.kind = ShapeKind::ball;
    body.shape.ball_cells = 10;
    body.shape.radius = 0.05;
    body.material.density = 1100;
    body.material.youngs_modulus = 1e8;
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    const auto substeps = [&] { return resolve(scene).method.substeps; };
    const std::uint32_t falling = substeps();
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    const std::uint32_t on_a_point = substeps();
    CHECK(on_a_point > 80); // 40 still make energy there (docs/methods.md)
    CHECK(on_a_point > 2 * falling);
    body.material.youngs_modulus = 1e4;
    CHECK(substeps() == falling); // soft: weight strains it more than a sweep leaves
    body.material.youngs_modulus = 1e8;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {10, 10, 10};
    body.shape.box_size = {0.1, 0.1, 0.1};
    CHECK(substeps() < on_a_point / 2);
}

TEST_CASE("a sail that is held all round takes what the wind asks for, a flag does not", "[substeps]")
{
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.bodies.resize(1);
    Body& body = scene.bodies[0];
    body.shape.cells = {10, 10};
    body.material.density = 0.2;
    body.material.drag = 1.2;
    body.material.stretch_stiffness = 0;
    body.material.fabric = {.used = true, .warp = 5000, .weft = 5000, .shear = 500};
    scene.wind.density = 1.2;
    scene.wind.keys = {{0, {0, 0, 1}}, {1, {0, 0, 4}}, {2, {9, 0, 0}}}; // the last blows along the sail
    scene.method.substeps = 0;
    const auto substeps = [&](const char* method, std::vector<std::string> edges) {
        body.pins.clear();
        body.pins.emplace_back().edges = std::move(edges);
        scene.method.type = option_named<MethodKind>(method);
        return resolve(scene).method.substeps;
    };
    const std::uint32_t sail = substeps("xpbd", {"top", "bottom", "left", "right"});
    CHECK(sail > 50); // with 10 it bulges by 73 mm instead of 41 (docs/methods.md)
    CHECK(substeps("pbd", {"top", "bottom", "left", "right"}) == sail);
    CHECK(substeps("implicit_euler", {"top", "bottom", "left", "right"}) == 10);
    CHECK(substeps("xpbd", {"left"}) == 10);
    scene.gravity = {0, -1e-3, 0};
    CHECK(substeps("xpbd", {"top", "bottom", "left", "right"}) == sail);
    scene.wind.keys = {{0, {4, 0, 4}}}; // 32 (m/s)^2 at 45 degrees: more than 16 straight at it
    CHECK(substeps("xpbd", {"top", "bottom", "left", "right"}) > sail);
    scene.wind.velocity = {0, 0, 40}; // nobody sees it: the first key is at the start
    CHECK(substeps("xpbd", {"top", "bottom", "left", "right"}) < 2 * sail);
    scene.wind.keys.clear();
    scene.wind.velocity = {0, 0, 4};
    CHECK(substeps("xpbd", {"top", "bottom", "left", "right"}) == sail);
    scene.wind.velocity = {0, 0, 0};
    CHECK(substeps("xpbd", {"top", "bottom", "left", "right"}) == 10);
}

TEST_CASE("without gravity held cloth under vbd takes the substeps of its waves", "[substeps]")
{
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].shape.cells = {6, 6};
    scene.bodies[0].material.stretch_stiffness = 1e4;
    scene.bodies[0].pins.emplace_back().edges = {"left"};
    scene.method.type = MethodKind::vbd;
    const auto substeps = [&](double g) {
        scene.method.substeps = 0;
        scene.gravity = {0, -g, 0};
        return resolve(scene).method.substeps;
    };
    CHECK(substeps(1e-6) > 20);
    CHECK(substeps(0) == substeps(1e-6));
}

TEST_CASE("cloth that stands out by its bending stiffness takes substeps by its edges", "[substeps]")
{
    Scene scene;
    scene.bodies.resize(1);
    Body& body = scene.bodies[0];
    body.shape.cells = {2, 8};
    body.shape.size = {0.0125, 0.05};
    body.material.density = 0.2;
    body.material.bending_stiffness = 0.003;
    body.pins.emplace_back().vertices = {0, 1, 2, 3, 4, 5}; // two rows
    scene.method.type = MethodKind::xpbd;
    const auto substeps = [&] {
        scene.method.substeps = 0;
        return resolve(scene).method.substeps;
    };
    scene.gravity = {0, 0, -9.81}; // across the strip
    const double standing = substeps();
    CHECK(standing > 100);
    body.material.bending_stiffness = 0.3; // what sags too far does not depend on it
    CHECK(substeps() == standing);
    body.material.fabric = {.used = true, .warp = 1e4, .weft = 1e4, .shear = 1e3};
    body.material.stretch_stiffness = body.material.bending_stiffness = 0;
    body.material.fabric.bending = {.used = true, .warp = 1e-9, .weft = 0.003};
    CHECK(substeps() == standing);
    body.material.fabric = {};
    body.material.stretch_stiffness = 10;
    body.material.bending_stiffness = 0.3;
    CHECK(substeps() == standing);
    scene.method.type = MethodKind::vbd; // whose steps at a vertex are in balance with its hinges
    CHECK(substeps() < standing / 2);
    scene.method.type = MethodKind::xpbd;
    body.pins[0].vertices = {0, 1, 2}; // an axle
    CHECK(substeps() < standing / 2);
    body.pins[0].vertices = {0, 1, 2, 3, 4, 5};
    scene.gravity = {0, -9.81, 0}; // along it, from one end or from the other
    const double hanging = substeps();
    scene.gravity = {0, 9.81, 0};
    CHECK(std::min<double>(hanging, substeps()) < standing / 2);
}

TEST_CASE("cloth that is too limp to stand out takes the substeps of its weight", "[substeps]")
{
    Scene scene;
    scene.bodies.resize(1);
    Body& body = scene.bodies[0];
    body.shape.cells = {2, 32};
    body.shape.size = {0.0625, 1};
    body.material.density = 0.2;
    body.pins.emplace_back().vertices = {0, 1, 2, 3, 4, 5};
    scene.gravity = {0, 0, -9.81};
    scene.method.type = MethodKind::xpbd;
    const auto substeps = [&](double rigidity) -> double {
        body.material.bending_stiffness = rigidity;
        scene.method.substeps = 0;
        return resolve(scene).method.substeps;
    };
    const double length = 31.0 / 32, limit = 0.2 * 9.81 * length * length * length / 16;
    CHECK(substeps(0.9 * limit) == substeps(0));
    CHECK(substeps(1.1 * limit) > 1.5 * substeps(0));
    CHECK(substeps(4.4 * limit) == Approx(2 * substeps(1.1 * limit)).margin(2)); // no softer than by a fifth
}

TEST_CASE("more sweeps of contact are taken where a solid can meet something", "[substeps]")
{
    Scene scene = test::hanging(2);
    Body& box = scene.bodies.emplace_back();
    box.shape.kind = ShapeKind::box;
    box.material = solid_material();
    box.material.density = 1; // heavier ones: tests/physics/laden_cloth_test.cpp
    scene.contact.sweeps = 0; // of hanging(), which is resolved
    const auto sweeps = [&] { return resolve(scene).contact.sweeps; };
    CHECK(sweeps() == 2); // nothing meets
    scene.contact.between = true;
    CHECK(sweeps() == 8);
    scene.bodies[1].contact.passes = {"default"};
    scene.bodies[1].contact.group = "box";
    CHECK(sweeps() == 2);
    scene.bodies[1].contact.self = true;
    CHECK(sweeps() == 8);
    scene.contact.sweeps = 3;
    CHECK(sweeps() == 3);
    CHECK(parse_scene(R"({"taut": 1, "contact": {"sweeps": "automatic"}})").contact.sweeps == 0);
}
