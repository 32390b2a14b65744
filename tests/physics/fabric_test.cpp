// Membranes of woven cloth under every method that has them: answers in closed form that cloth of springs, or
// without shear, does not give.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"

#include "taut/taut.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace taut;
using namespace taut::elements_test;

namespace {

const std::vector<std::string> kMethods = {"xpbd", "mass_spring", "implicit_euler", "vbd"};
constexpr double kDensity = 0.2;

/// Cloth without springs, `cells` over `size` m, in the plane z = 0; vertices within are moved by a share of
/// their cell, so that no two triangles are alike.
Scene sheet(const std::string& method, const glm::uvec2& cells, const glm::dvec2& size, double jitter)
{
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.method.type = method;
    scene.method.precision = "double";
    if (method == "mass_spring")
        scene.method.stability = "substep";
    Body body;
    body.shape.cells = cells;
    body.shape.size = size;
    body.material.density = kDensity;
    body.material.stretch_stiffness = 0;
    scene.bodies.push_back(body);
    scene = resolve(scene);
    conformance::Random random(7);
    Mesh& mesh = scene.bodies[0].mesh;
    for (std::size_t row = 1; row + 1 < mesh.grid_rows; ++row)
        for (std::size_t column = 1; column + 1 < mesh.grid_columns; ++column)
            mesh.positions[row * mesh.grid_columns + column] +=
                jitter * glm::dvec3(random.uniform(-1, 1) * size.x / cells.x,
                                    random.uniform(-1, 1) * size.y / cells.y, 0);
    return scene;
}

/// Moduli of fabric.md's strip of off-axis tests, N/m.
FabricMatrix yarns()
{
    Fabric fabric;
    fabric.warp = 5000;
    fabric.weft = 2500;
    fabric.poissons_ratio = 0.3;
    fabric.shear = 60;
    return fabric_matrix(fabric);
}

/// A membrane for every triangle of the plane z = 0; the warp at an angle to x, radians.
void weave(Scene& scene, const FabricMatrix& c, double angle)
{
    Body& body = scene.bodies[0];
    const glm::dvec3 warp(std::cos(angle), std::sin(angle), 0), weft(-warp.y, warp.x, 0);
    Body::Elements list{"membrane", {}, {}};
    for (const auto& t : body.mesh.triangles)
    {
        const auto& x = body.mesh.positions;
        const glm::dvec3 e1 = x[t[1]] - x[t[0]], e2 = x[t[2]] - x[t[0]];
        const double a = glm::dot(e1, warp), b = glm::dot(e2, warp), d = glm::dot(e1, weft),
                     e = glm::dot(e2, weft), det = a * e - b * d, area = std::abs(det) / 2;
        list.vertices.insert(list.vertices.end(), t.begin(), t.end());
        for (const double value : {e / det, -b / det, -d / det, a / det})
            list.values.push_back(value);
        for (const double value : {c.c11, c.c12, c.c22, c.c33})
            list.values.push_back(value * area);
    }
    body.elements.push_back(list);
}

double run_energy(World& world)
{
    const StepReport report = measure(world);
    return report.potential_energy + report.kinetic_energy;
}

} // namespace

TEST_CASE("a strip that is pulled at an angle to its yarns is as stiff as the orthotropic law says")
{
    add_elements();
    const std::string method = GENERATE(from_range(kMethods));
    const int degrees = GENERATE(0, 15, 30, 45, 60, 75, 90);
    CAPTURE(method, degrees);
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const double compliance =
        std::pow(c, 4) / 5000 + std::pow(s, 4) / 2500 + (1 / 60.0 - 0.6 / 5000) * c * c * s * s;
    const double side = 0.2, strain = 1e-3, traction = strain / compliance;
    Scene scene = sheet(method, {4, 4}, {side, side}, 0.2);
    weave(scene, yarns(), -angle); // the pull is along x
    scene.external_forces = true;
    scene.timestep = 1.0 / 60;
    scene.method.substeps = 20;
    scene.method.iterations = method == "vbd" || method == "xpbd" ? 4 : 1;
    scene.damping = 10;
    World world(scene, test_device("cpu:serial"));
    const Mesh& mesh = scene.bodies[0].mesh;
    std::vector<glm::dvec3> forces(mesh.positions.size(), glm::dvec3(0));
    for (std::size_t row = 0; row < 5; ++row)
    {
        const double share = (row == 0 || row == 4 ? 0.125 : 0.25) * side * traction;
        forces[row * 5] = {-share, 0, 0};
        forces[row * 5 + 4] = {share, 0, 0};
    }
    for (int frame = 0; frame < 120; ++frame)
    {
        world.set_forces(forces);
        world.step();
    }
    const auto x = world.positions();
    double worst = 0;
    for (std::size_t row = 0; row < 5; ++row)
        worst = std::max(worst, std::abs((x[row * 5 + 4].x - x[row * 5].x) / side - 1 - strain));
    CHECK(worst < 0.005 * strain);
}
