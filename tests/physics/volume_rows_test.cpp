// Claims about volumes of tetrahedra as rows of implicit_constraints: F04 of docs/hard-cases.md.

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace taut;

namespace {

constexpr double kRigid = std::numeric_limits<double>::infinity();

/// examples/scenes/solids/kept.json with `cells` along an edge.
Scene dropped(std::uint32_t cells)
{
    Scene scene;
    scene.timestep = 0.01;
    scene.damping = 0.5;
    scene.method.type = MethodKind::implicit_constraints;
    scene.method.linear_operator = LinearOperator::matrix_free;
    scene.method.linear_iterations = 300;
    scene.method.linear_tolerance = 1e-4;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = glm::uvec3(cells);
    body.transform.translate = {0, 1, 0};
    body.material = solid_material();
    body.material.density = 100;
    body.material.model = SolidModel::springs;
    body.material.youngs_modulus = 2e4;
    body.material.volume_stiffness = kRigid;
    body.material.stretch_damping = 0.002;
    scene.bodies = {body};
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.friction = 0.3;
    scene.colliders = {floor};
    return scene;
}

double least_volume(const Scene& scene, int steps)
{
    World world(resolve(scene), test_device("cpu:serial"));
    double least = 1;
    for (int k = 0; k < steps; ++k)
    {
        world.step();
        least = std::min(least, measure(world).volume.ratio);
    }
    CHECK(measure(world).status == Status::completed);
    return least;
}

double largest_distance(const World& a, const World& b)
{
    double out = 0;
    for (std::size_t v = 0; v < a.positions().size(); ++v)
        out = std::max(out, glm::distance(a.positions()[v], b.positions()[v]));
    return out;
}

} // namespace

TEST_CASE("a box dropped on the floor keeps 98.7 % of its volume, which its springs alone do not",
          "[volume_rows]")
{
    const Scene held = dropped(4);
    Scene free = held;
    free.bodies[0].material.volume_stiffness = 0;
    CHECK(least_volume(held, 200) > 0.987);
    CHECK(least_volume(free, 200) < 0.95);
}

TEST_CASE("one tetrahedron of six rigid edges moves the same with and without its volume (F04)",
          "[volume_rows]")
{
    const std::string precision = GENERATE("float", "double");
    CAPTURE(precision);
    Scene scene = dropped(1);
    scene.colliders.clear();
    scene.damping = 0;
    scene.method.precision = option_named<Precision>(precision);
    scene.method.linear_tolerance = precision == "double" ? 1e-10 : 1e-5;
    scene.method.constraint_compliance = 0;
    scene = resolve(scene);
    Body& body = scene.bodies[0];
    body.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    body.mesh.tetrahedra = {{0, 1, 2, 3}};
    body.mesh.triangles = surface_of(body.mesh.tetrahedra);
    body.pins.resize(1);
    body.pins[0].vertices = {0};
    Scene edges = scene;
    edges.bodies[0].material.volume_stiffness = 0;
    World redundant(scene, test_device("cpu:serial")), plain(edges, test_device("cpu:serial"));
    for (int k = 0; k < 100; ++k)
    {
        redundant.step();
        plain.step();
    }
    const StepReport report = measure(redundant);
    CHECK(report.status == Status::completed);
    CHECK(glm::distance(redundant.positions()[3], glm::dvec3(0, 0, 1)) > 0.1); // it swings
    CHECK(std::abs(report.volume.ratio - 1) < 1e-3);
    CHECK(largest_distance(redundant, plain) < 1e-4);
}

TEST_CASE("executors agree on rows of tetrahedra, with compliance and further solves", "[volume_rows]")
{
    Scene scene = dropped(2);
    scene.method.iterations = 2;
    scene.method.substeps = 2;
    scene.bodies[0].material.volume_stiffness = 1e5;
    scene.bodies[0].transform.translate = {0, 0.5, 0};
    scene = resolve(scene);
    World reference(scene, test_device("cpu:serial"));
    for (int k = 0; k < 10; ++k)
        reference.step();
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        World world(scene, test_device(selector));
        for (int k = 0; k < 10; ++k)
            world.step();
        CHECK(largest_distance(world, reference) <
              (test_device(selector)->info().hardware_gpu ? 1e-3 : 1e-12));
        CHECK(test_device(selector)->counters().validation_messages == 0);
    }
}

TEST_CASE("an assembled matrix holds the same volumes", "[volume_rows]")
{
    Scene scene = dropped(2);
    scene.method.precision = Precision::float64;
    scene.method.linear_tolerance = 1e-10;
    scene.method.substeps = 2;
    scene.bodies[0].material.volume_stiffness = 1e5;
    World free(resolve(scene), test_device("cpu:serial"));
    scene.method.linear_operator = LinearOperator::assembled;
    World stored(resolve(scene), test_device("cpu:serial"));
    for (int k = 0; k < 20; ++k)
    {
        free.step();
        stored.step();
    }
    CHECK(largest_distance(free, stored) < 1e-7);
}
