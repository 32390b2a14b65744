// What bodies do as a whole under vertex block descent, whatever their sweeps leave: they slide as a point
// does, and lie where they lie.

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>

using namespace taut;

namespace {

Scene block_on_plane(double youngs_modulus, double slope_degrees, std::uint32_t iterations)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 2, 3};
    body.shape.box_size = {0.1, 0.04, 0.1};
    body.material = solid_material();
    body.material.youngs_modulus = youngs_modulus;
    body.material.poissons_ratio = 0.45;
    body.transform.translate = {0, 0.021, 0};
    scene.bodies = {body};
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    const double angle = glm::radians(slope_degrees);
    scene.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle),
                     0}; // the plane is level, gravity is not
    scene.method.type = MethodKind::vbd;
    scene.method.substeps = 10;
    scene.method.iterations = iterations;
    return scene;
}

glm::dvec3 mean_way(const World& world, const std::vector<glm::dvec3>& start)
{
    const std::vector<glm::dvec3> x = world.positions();
    glm::dvec3 sum(0);
    for (std::size_t v = 0; v < x.size(); ++v)
        sum += x[v] - start[v];
    return sum / static_cast<double>(x.size());
}

} // namespace

TEST_CASE("a solid slides down a slope as a point does, at any stiffness and with few sweeps", "[vbd]")
{
    const double stiffness = GENERATE(1e5, 1e7, 1e9), friction = GENERATE(0.0, 0.1);
    const std::uint32_t sweeps = GENERATE(1u, 5u);
    CAPTURE(stiffness, friction, sweeps);
    Scene scene = block_on_plane(stiffness, 20, sweeps);
    scene.colliders[0].friction = friction;
    World world(scene, test_device("cpu:serial"));
    const std::vector<glm::dvec3> start = world.positions();
    for (int k = 0; k < 60; ++k)
        world.step();
    const double angle = glm::radians(20.0);
    const double right = 0.5 * 9.81 * (std::sin(angle) - friction * std::cos(angle));
    CHECK(mean_way(world, start).x == Approx(right).epsilon(0.01));
}

TEST_CASE("a stiff solid at rest stays where it is, with one sweep", "[vbd]")
{
    const double stiffness = GENERATE(1e6, 1e8, 1e10);
    const std::uint32_t sweeps = GENERATE(1u, 2u, 5u);
    CAPTURE(stiffness, sweeps);
    World world(block_on_plane(stiffness, 0, sweeps), test_device("cpu:serial"));
    const std::vector<glm::dvec3> start = world.positions();
    for (int k = 0; k < 240; ++k)
        world.step();
    const StepReport report = measure(world);
    CHECK(report.volume.inverted == 0);
    const std::vector<glm::dvec3> x = world.positions();
    double most = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
        most = std::max(most, glm::distance(x[v], start[v]));
    CHECK(most < 1e-3); // a hundredth of its length; it stands 1 mm above its contacts at first
}
