// Stiff cloth and chains under vertex block descent with few sweeps swing, and cloth makes no energy
// (docs/methods/vbd.md).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// A level square of 1 m, held by an edge, of 1e5 N/m.
Scene level_sheet(const char* method, std::uint32_t substeps)
{
    Scene scene;
    Body body;
    body.shape.cells = {4, 4};
    body.material.stretch_stiffness = 1e5;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    Pin pin;
    pin.edges = {"top"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    scene.accept.stretch = 2; // how it swings is asked here, not how far the springs are from solved
    return scene;
}

/// m: mean height against the pins after a second; it swings down and up again in that time.
double height_after_a_second(const char* method, std::uint32_t substeps)
{
    World world(level_sheet(method, substeps), test_device("cpu:serial"));
    const double start = energy(world);
    double most = start, sum = 0;
    for (int step = 0; step < 60; ++step)
    {
        world.step();
        most = std::max(most, energy(world));
    }
    for (const glm::dvec3& x : world.positions())
        sum += x.y / static_cast<double>(world.positions().size());
    CHECK(most - start < 0.02); // J, of 0.2 kg that fall by up to half a metre, 1 J
    return sum;
}

/// Three links of 8e3 N/m in 7 cm, held by the first vertex and let go near level: its free end after
/// 0.35 s.
glm::dvec3 end_of_chain(const char* method, std::uint32_t substeps)
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 3;
    body.shape.length = 0.07;
    body.material.stretch_stiffness = 8e3;
    body.transform.rotate_axis = {0, 0, 1};
    body.transform.rotate_degrees = 85;
    body.pins.emplace_back().corners = {"first"};
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    World world(resolve(scene), test_device("cpu:serial"));
    for (int step = 0; step < 21; ++step)
        world.step();
    const glm::dvec3 end = world.positions().back();
    StepReport report = measure(world);
    judge_residuals(world.scene(), residuals_ahead(world), report); // which takes steps
    CHECK(report.status == Status::completed);
    return end;
}

} // namespace

TEST_CASE("a chain that swings ends where it should under vbd with the substeps that it takes", "[vbd]")
{
    const glm::dvec3 right = end_of_chain("xpbd", 1000);
    CHECK(glm::distance(right, end_of_chain("implicit_euler", 300)) < 0.02 * 0.07);
    // With 15, which its weight alone asks for, it is off by half its length.
    CHECK(glm::distance(right, end_of_chain("vbd", 0)) < 0.12 * 0.07);
}

TEST_CASE("stiff level cloth comes up again as under implicit Euler, with one sweep a substep", "[vbd]")
{
    const double right = height_after_a_second("implicit_euler", 40);
    CAPTURE(right);
    for (const std::uint32_t substeps : {0u, 10u, 40u}) // 0: automatic
    {
        CAPTURE(substeps);
        CHECK(height_after_a_second("vbd", substeps) > right - 0.2);
    }
}
