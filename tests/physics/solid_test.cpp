// Claims about solids under XPBD.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/mean.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

using namespace taut;

namespace {

Scene block(const std::string& model, std::uint32_t substeps, std::uint32_t iterations)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    scene.bodies = {body};
    return resolve(scene);
}

/// Root mean square distance to the rest shape after moving it to the same centre; the starts below do not
/// turn.
double shape_error(const Scene& scene, const std::vector<glm::dvec3>& x)
{
    const auto& rest = scene.bodies[0].mesh.positions;
    const glm::dvec3 centre = test::mean(x), own = test::mean(rest);
    double sum = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
        sum += glm::dot(x[v] - centre - (rest[v] - own), x[v] - centre - (rest[v] - own));
    return std::sqrt(sum / static_cast<double>(x.size()));
}

} // namespace

TEST_CASE("a solid at rest stays at rest, with many iterations and with many substeps", "[solid]")
{
    const std::string model = GENERATE("neo_hookean", "neo_hookean_simple", "springs");
    for (const auto& [substeps, iterations] : {std::pair{1u, 20u}, std::pair{20u, 1u}})
        for (const std::string& selector : test_devices())
        {
            CAPTURE(model, substeps, iterations, selector);
            World world(block(model, substeps, iterations), test_device(selector));
            for (int frame = 0; frame < 60; ++frame)
                world.step();
            const StepReport report = measure(world);
            CHECK(report.status == Status::completed);
            CHECK(std::abs(report.volume.ratio - 1) < 1e-5);
            CHECK(report.volume.inverted == 0);
            CHECK(report.max_speed < 1e-3);
            CHECK(shape_error(world.scene(), world.positions()) < 1e-5);
        }
}

TEST_CASE("a block squeezed to a plane or mirrored comes back to its shape", "[solid]")
{
    const double z = GENERATE(0.0, -1.0);
    const std::string model = GENERATE("neo_hookean", "neo_hookean_simple");
    CAPTURE(z, model);
    Scene scene = block(model, 20, 1);
    scene.damping = 2;
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x.z *= z;
    World world(scene, test_device("cpu:serial"));
    for (int frame = 0; frame < 600; ++frame)
        world.step();
    const StepReport report = measure(world);
    CHECK(report.status == Status::completed);
    CHECK(report.volume.inverted == 0);
    CHECK(std::abs(report.volume.ratio - 1) < 1e-3);
}

TEST_CASE("a stretched block let go swings without gaining energy, and its centre stays", "[solid]")
{
    const std::string model = GENERATE("neo_hookean", "springs");
    CAPTURE(model);
    Scene scene = block(model, 20, 1);
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x.x *= 1.5;
    World world(scene, test_device("cpu:serial"));
    const double before = measure(world).potential_energy;
    const glm::dvec3 start = test::mean(world.positions());
    for (int frame = 0; frame < 60; ++frame)
    {
        world.step();
        const StepReport report = measure(world);
        CHECK(report.kinetic_energy + report.potential_energy < before * (1 + 1e-3));
        CHECK(glm::distance(test::mean(world.positions()), start) < 1e-4); // rounding of 1200 substeps
    }
}
