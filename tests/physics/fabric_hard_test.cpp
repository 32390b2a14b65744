// Hard cases of fabrics under every method that has membranes: starts far from rest, and moduli far apart.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"

#include "taut/taut.hpp"

#include <glm/geometric.hpp>

using namespace taut;

namespace {

const std::vector<std::string> kMethods = {"xpbd", "mass_spring", "implicit_euler", "vbd"};

/// A weightless square of 8 x 8 cells a metre wide, with the warp along `grain`.
Scene square(const std::string& method, double warp, double weft, double shear, const glm::dvec3& grain)
{
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.damping = 3;
    scene.duration = 4;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = 40;
    scene.method.iterations = method == "vbd" || method == "xpbd" ? 4 : 1;
    if (method == "mass_spring")
        scene.method.stability = StabilityRule::substep;
    Body body;
    body.shape.cells = {8, 8};
    body.material.stretch_stiffness = 0;
    body.material.fabric.used = true;
    body.material.fabric.warp = warp;
    body.material.fabric.weft = weft;
    body.material.fabric.shear = shear;
    body.material.fabric.grain = grain;
    scene.bodies.push_back(body);
    return resolve(scene);
}

/// m, along x between the middles of both sides.
double width(const World& world)
{
    const auto x = world.positions();
    return x[4 * 9 + 8].x - x[4 * 9].x;
}

} // namespace

TEST_CASE("a fabric whose vertices start anywhere comes back to its shape, under every method")
{
    const std::string method = GENERATE(from_range(kMethods));
    const std::string precision = GENERATE("float", "double");
    CAPTURE(method, precision);
    Scene scene = square(method, 3000, 1000, 30, {0, 1, 0});
    scene.method.precision = option_named<Precision>(precision);
    scene.bodies[0].material.bending_stiffness = 1e-4;
    conformance::Random random(3);
    for (std::size_t v = 0; v < scene.bodies[0].mesh.positions.size(); ++v)
        scene.bodies[0].start_positions.emplace_back(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3),
                                                     random.uniform(-0.3, 0.3));
    World world(scene, test_device("cpu:serial"));
    const double before = measure(world).potential_energy;
    while (world.time() < scene.duration)
        world.step();
    const StepReport after = measure(world);
    CAPTURE(after.reason);
    CHECK(after.status == Status::completed);
    CHECK(after.potential_energy + after.kinetic_energy < 2e-3 * before);
    CHECK(after.warnings.count("degenerate") == 0);
}

TEST_CASE("yarns a million times as stiff as their shear leave a bias as soft as it is, under every method")
{
    const std::string method = GENERATE(from_range(kMethods));
    CAPTURE(method);
    const double stiff = 1e4, shear = 0.01, bias = 4 / (1 / shear + 2 / stiff), strain = 0.01;
    Scene scene = square(method, stiff, stiff, shear, {1, 1, 0});
    scene.method.precision = Precision::float64;
    scene.method.substeps = 100;
    scene.damping = 1;
    scene.duration = 12;
    scene.external_forces = true;
    World world(scene, test_device("cpu:serial"));
    std::vector<glm::dvec3> forces(81, glm::dvec3(0)); // a traction along x
    for (std::size_t row = 0; row < 9; ++row)
    {
        const double share = (row == 0 || row == 8 ? 0.0625 : 0.125) * bias * strain;
        forces[row * 9] = {-share, 0, 0};
        forces[row * 9 + 8] = {share, 0, 0};
    }
    world.set_forces(forces);
    while (world.time() < scene.duration)
        world.step();
    CHECK(width(world) - 1 == Approx(strain).epsilon(0.02)); // of 0.01 the shear is not linear to a percent
}
