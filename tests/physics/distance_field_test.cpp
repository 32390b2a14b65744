// Claims about distance fields as colliders: what lies on one lies as on the shape that it is of.

#include "hard/cases.hpp"
#include "support/box_distance.hpp"
#include "support/methods.hpp"
#include "support/sheets.hpp"

#include "taut/judge/mesh_distance.hpp"
#include "taut/report/crossing.hpp"
#include "taut/report/holes.hpp"
#include "taut/scene/collider.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::hard;

namespace {

Collider field_of(const std::function<double(const glm::dvec3&)>& distance, double half, double cell)
{
    DistanceField field;
    const auto points = static_cast<std::uint32_t>(2 * half / cell) + 1;
    field.points = {points, points, points};
    field.low = glm::dvec3(-half);
    field.cell = cell;
    for (std::uint32_t k = 0; k < points; ++k)
        for (std::uint32_t j = 0; j < points; ++j)
            for (std::uint32_t i = 0; i < points; ++i)
                field.values.push_back(static_cast<float>(distance(field.place(i, j, k))));
    Collider out;
    out.kind = ColliderKind::distance_field;
    out.field = std::make_shared<const DistanceField>(std::move(field));
    return out;
}

Collider box_field(const glm::dvec3& half, double cell)
{
    const double reach = std::max({half.x, half.y, half.z}) + 2 * cell;
    return field_of([&](const glm::dvec3& p) { return test::box_distance(p, half); }, reach, cell);
}

Scene falling(const std::vector<glm::dvec3>& places, const Collider& collider)
{
    Scene scene = alone(particles(places));
    scene.gravity = {0, -9.81, 0};
    scene.colliders = {collider};
    return scene;
}

/// A sheet of 60 cm that falls onto a kinematic body.
Scene sheet_over(Body shape)
{
    shape.name = "shape";
    shape.kinematic.used = true;
    shape.material.thickness = 0.001;
    Scene scene;
    scene.bodies = {test::level_sheet(20, 0.6, {0, 0.32, 0}, 0.005), std::move(shape)};
    scene.contact.between = true;
    scene.contact.friction = 0.4;
    scene.damping = 1;
    scene.method.substeps = 16;
    return scene;
}

/// The same with a field of the body's surface in its place.
Scene with_field(const Scene& scene, double cell)
{
    const Scene resolved = resolve(scene);
    const Mesh& mesh = resolved.bodies[1].mesh;
    const judging::MeshDistance surface(mesh.triangles, mesh.positions);
    Scene out = scene;
    out.bodies.pop_back();
    out.contact.between = false;
    Collider collider;
    collider.kind = ColliderKind::distance_field;
    collider.friction = 0.4;
    collider.field = std::make_shared<const DistanceField>(
        judging::make_distance_field(surface, mesh.positions, cell, 2 * cell));
    out.colliders = {collider};
    return out;
}

struct Heights
{
    double mean = 0, highest = -1e300, lowest = 1e300;
};

/// Of the sheet, the first body, after 1.25 s.
Heights fallen(const Scene& scene)
{
    World world(scene, test_device("cpu"));
    run(world, 75);
    check_sound(world);
    const std::size_t count = world.scene().bodies[0].mesh.positions.size();
    Heights out;
    for (std::size_t v = 0; v < count; ++v)
    {
        const double y = world.positions()[v].y;
        out.mean += y / double(count);
        out.highest = std::max(out.highest, y);
        out.lowest = std::min(out.lowest, y);
    }
    return out;
}

} // namespace

TEST_CASE("what falls on a distance field rests where it says the thickness", "[distance_field]")
{
    const auto ball = [](const glm::dvec3& p) { return glm::length(p) - 0.5; };
    const Scene scene = falling({{0, 0.7, 0}, {0.013, 0.55, 0.02}}, field_of(ball, 0.65, 0.05));
    test::on_methods_and_devices(scene, [](const Scene& s, const auto& device) {
        World world(s, device);
        run(world, 30);
        check_sound(world);
        const glm::dvec3 top = world.positions()[0];
        CHECK(s.colliders[0].field->distance(top) == Approx(0.001).margin(2e-6));
        CHECK(top.y == Approx(0.501).margin(0.05 * 0.05 / 4 / 0.5)); // what is linear within a cell is off by
        CHECK(glm::length(world.positions()[1]) >= 0.5);
    });
}

TEST_CASE("on a field of a tilted box friction slows by mu g cos and holds at tan", "[distance_field]")
{
    const double slope = std::atan(0.5);
    const glm::dvec3 down(-std::cos(slope), -std::sin(slope), 0), up(-std::sin(slope), std::cos(slope), 0);
    for (const double mu : {0.0, 0.3, 0.49, 0.51})
    {
        Collider ramp = box_field({3, 0.5, 0.5}, 0.125);
        ramp.rotate_axis = {0, 0, 1};
        ramp.rotate_degrees = slope * 180 / 3.14159265358979323846;
        ramp.friction = mu;
        test::on_methods_and_devices(
            falling({0.501 * up - 1.0 * down}, ramp), [&](const Scene& s, const auto& device) {
                World world(s, device);
                const glm::dvec3 start = world.positions()[0];
                run(world, 45);
                check_sound(world);
                const double exact = std::max(0.75 * 9.81 * (std::sin(slope) - mu * std::cos(slope)), 0.0);
                CHECK(glm::dot(world.velocities()[0], down) == Approx(exact).margin(2e-3 * 9.81));
                if (mu > 0.5)
                    CHECK(glm::distance(world.positions()[0], start) < 1e-4);
            });
    }
}

TEST_CASE("a stiff cube that friction holds on a field under vbd does not creep", "[distance_field]")
{
    Body cube;
    cube.shape.kind = ShapeKind::box;
    cube.shape.box_cells = {3, 3, 3};
    cube.shape.box_size = glm::dvec3(0.1);
    cube.material = solid_material();
    cube.material.youngs_modulus = 1e7;
    cube.material.thickness = 0.001;
    cube.transform.translate = {0, 0.551, 0};
    Scene scene;
    scene.bodies = {cube};
    scene.colliders = {box_field({1, 0.5, 0.5}, 0.125)};
    scene.colliders[0].friction = 0.8;
    scene.gravity = {0.5 * 9.81, -std::sqrt(0.75) * 9.81, 0}; // 30 degrees, tan = 0.58
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = 10;
    World world(scene, test_device("cpu:serial"));
    run(world, 120);
    check_sound(world);
    const std::vector<glm::dvec3> settled = world.positions();
    run(world, 120);
    double most = 0;
    for (std::size_t v = 0; v < settled.size(); ++v)
        most = std::max(most, glm::distance(world.positions()[v], settled[v]));
    CHECK(most < 1e-6); // 2.5e-7; 7e-3 where contacts follow the sweeps
}

TEST_CASE("a field that moves and turns takes along what lies on it as a box does", "[distance_field]")
{
    Collider box;
    box.kind = ColliderKind::cuboid;
    box.half_size = {0.5, 0.25, 0.5};
    Collider field = box_field({0.5, 0.25, 0.5}, 0.0625);
    for (Collider* c : {&box, &field})
    {
        c->friction = 0.5;
        c->motion = {{0, {0, 0, 0}}, {1, {0.5, 0.1, 0}, {0, 1, 0}, 60, {0, 0, 0}}};
    }
    const std::vector<glm::dvec3> places{{0.2, 0.251, 0.1}, {-0.1, 0.3, -0.2}};
    for (const std::string method : {"xpbd", "implicit_euler"})
    {
        CAPTURE(method);
        std::vector<glm::dvec3> ends[2];
        for (const std::size_t k : {0, 1})
        {
            Scene scene = falling(places, k == 0 ? box : field);
            scene.method.type = option_named<MethodKind>(method);
            World world(scene, test_device("cpu"));
            run(world, 60);
            check_sound(world);
            ends[k] = world.positions();
        }
        for (std::size_t v = 0; v < places.size(); ++v)
        {
            CHECK(glm::distance(ends[0][v], ends[1][v]) < 1e-3);
            CHECK(ends[1][v].x > 0.2); // it was taken along
        }
    }
}

TEST_CASE("what is fast is stopped where it comes in, and does not end on the other side", "[distance_field]")
{
    Scene scene = falling({{0.01, 0.4, 0.02}}, box_field({0.4, 0.05, 0.4}, 0.03125));
    scene.bodies[0].velocity = {0, -GENERATE(1.0, 20.0, 100.0), 0};
    test::on_methods_and_devices(scene, [](const Scene& s, const auto& device) {
        World world(s, device);
        run(world, 10);
        check_sound(world);
        CHECK(world.positions()[0].y > 0.045);
    });
}

TEST_CASE("what starts inside a field is let out as slowly as out of a box", "[distance_field]")
{
    const glm::dvec3 half(0.5, 0.025, 0.5);
    const double height = GENERATE(0.0001, 0.005, 0.01, 0.02, 0.0259); // the last one within the gap alone
    Scene scene = falling({{0.013, height, 0.021}}, box_field(half, GENERATE(0.025, 0.005)));
    scene.gravity = {0, 0, 0};
    scene.depenetration_speed = 0.5;
    World world(scene, test_device("cpu"));
    for (int step = 0; step < 30; ++step)
    {
        world.step();
        CHECK(std::abs(world.velocities()[0].y) < 1.02 * scene.depenetration_speed);
    }
    check_sound(world);
    CHECK(world.positions()[0].y > 0.025);
}

TEST_CASE("what starts within its gap, or inside, does not leave on the other side however fast",
          "[distance_field]")
{
    Scene scene = falling({{0.013, GENERATE(0.0259, 0.02, 0.2), 0.021}}, box_field({0.5, 0.025, 0.5}, 0.025));
    scene.bodies[0].velocity = {0, -GENERATE(20.0, 100.0), 0};
    World world(scene, test_device("cpu"));
    run(world, 30);
    CHECK(world.positions()[0].y > 0);
}

TEST_CASE("coarse cloth, or a chain, that goes through a limb of a field is noticed", "[distance_field]")
{
    // A body with an arm along x: its deepest point says nothing of the arm.
    const auto figure = [](const glm::dvec3& p) {
        return std::min(test::box_distance(p, glm::dvec3(0.2)),
                        test::box_distance(p - glm::dvec3(0.45, 0, 0), {0.3, 0.03, 0.03}));
    };
    Scene scene;
    scene.colliders = {field_of(figure, 0.8, 0.02)};
    const bool chain = GENERATE(false, true);
    if (chain)
    {
        Body body;
        body.shape.kind = ShapeKind::chain;
        body.shape.links = 2;
        body.shape.length = 0.5;
        body.transform.rotate_axis = {1, 0, 0};
        body.transform.rotate_degrees = 90;
        body.transform.translate = {0.55, 0.1, 0.37};
        scene.bodies = {body};
    }
    else
        scene.bodies = {test::level_sheet(2, 0.5, {0.65, 0.1, 0.11}, 0.005)};
    CHECK(holes_issues(resolve(scene)).size() == (chain ? 0 : 1));
    World world(scene, test_device("cpu"));
    CrossingWatch watch(world.scene());
    const double substep = world.scene().timestep / world.plan().substeps;
    for (std::uint64_t frame = 0; frame <= 40; ++frame)
    {
        watch.look(frame, world.time(), substep, world.positions(), world.velocities());
        world.step();
    }
    CHECK(world.positions()[0].y < -0.1);
    const Crossings found = watch.found();
    CHECK(found.passed + found.elements > 0);
}

TEST_CASE("suite 53: cloth lies on a distance field as on the mesh that it was made of", "[distance_field]")
{
    Body ball, box, ring;
    ball.material = box.material = solid_material();
    ball.shape.kind = ShapeKind::ball;
    ball.shape.radius = 0.2;
    ball.shape.ball_cells = 12;
    ball.transform.translate = {0, 0.05, 0};
    box.shape.kind = ShapeKind::box;
    box.shape.box_size = {0.3, 0.2, 0.25};
    box.shape.box_cells = {6, 4, 5};
    box.transform.translate = {0, 0.1, 0};
    box.transform.rotate_degrees = 20;
    ring.shape.kind = ShapeKind::mesh;
    ring.shape.file = TAUT_SOURCE_DIR "/examples/scenes/shapes/ring.obj";
    ring.transform.rotate_axis = {1, 0, 0};
    ring.transform.rotate_degrees = 90;
    ring.transform.translate = {0, 0.15, 0};
    constexpr double kCell = 0.02;
    for (const auto& [name, body] : {std::pair{"ball", ball}, {"box", box}, {"ring", ring}})
    {
        CAPTURE(name);
        const Scene mesh = sheet_over(body);
        const Heights by_mesh = fallen(mesh), by_field = fallen(with_field(mesh, kCell));
        const double allowed = kCell + 0.02 * (by_mesh.highest - by_mesh.lowest);
        CHECK(by_field.highest == Approx(by_mesh.highest).margin(allowed));
        CHECK(by_field.mean == Approx(by_mesh.mean).margin(allowed));
        CHECK(by_mesh.highest > 0.1); // it did not fall past
    }
}
