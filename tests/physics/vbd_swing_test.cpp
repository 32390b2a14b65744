// Stiff cloth under vertex block descent with few sweeps swings, and makes no energy (docs/methods/vbd.md).

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

} // namespace

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
