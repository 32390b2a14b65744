// A body that is let go deformed turns its elastic energy into motion, as much under every method: what a
// method pulls with is the gradient of the energy that reports give, so the material is the same everywhere.

#include "hard/cases.hpp"

#include "taut/report/energy_lost.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

struct Kind
{
    const char* name;
    Body body;
};

Body cloth()
{
    Body body;
    body.shape.cells = {4, 4};
    body.material.stretch_stiffness = 500;
    return body;
}

Body solid(SolidModel model)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_size = {0.3, 0.2, 0.2};
    body.shape.box_cells = {3, 2, 2};
    body.material = solid_material();
    body.material.youngs_modulus = 1e4;
    body.material.poissons_ratio = 0.4;
    body.material.model = model;
    return body;
}

/// Of each kind a body whose energy is mostly that of its element.
std::vector<Kind> kinds()
{
    std::vector<Kind> out{{"springs", cloth()}, {"hinges", cloth()}, {"fabric", cloth()}};
    out[1].body.material.stretch_stiffness = 200;
    out[1].body.material.bending_stiffness = 0.05;
    out[2].body.material.stretch_stiffness = 0; // its moduli take the place of springs
    out[2].body.material.fabric.used = true;
    out[2].body.material.fabric.warp = 500;
    out[2].body.material.fabric.weft = 300;
    out[2].body.material.fabric.shear = 100;
    out.push_back({"neo_hookean", solid(SolidModel::neo_hookean)});
    out.push_back({"neo_hookean_simple", solid(SolidModel::neo_hookean_simple)});
    return out;
}

/// Stretched by 5 %, squeezed by 3 %, sheared by 4 % and bent, all at once.
void deform(Body& body)
{
    Scene alone;
    alone.bodies = {body};
    const Scene resolved = resolve(alone); // outlives the loop
    for (const glm::dvec3& p : resolved.bodies[0].mesh.positions)
        body.start_positions.push_back(
            {1.05 * p.x + 0.04 * p.y, 0.97 * p.y, p.z + 0.2 * p.x * p.x - 0.1 * p.y * p.y});
}

StepReport let_go(const Body& body, MethodKind method)
{
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.bodies = {body};
    scene.method.type = method;
    scene.method.precision = Precision::float64;
    scene.method.substeps = 1000;
    scene.timestep = 0.01;
    World world(resolve(scene), test_device("cpu:serial"));
    world.step();
    return measure(world);
}

} // namespace

TEST_CASE("every method turns the energy that is reported into motion, and as much of it")
{
    for (Kind kind : kinds())
    {
        deform(kind.body);
        std::vector<MethodKind> methods{MethodKind::xpbd, MethodKind::vbd, MethodKind::implicit_euler};
        if (kind.body.shape.kind == ShapeKind::grid)
            methods.push_back(MethodKind::mass_spring); // which has no neo-Hookean solids
        const StepReport right = let_go(kind.body, methods.back());
        for (const MethodKind method : methods)
        {
            const StepReport report = let_go(kind.body, method);
            INFO(kind.name << " under " << to_string(method) << ": " << report.kinetic_energy << " J, lost "
                           << report.energy_lost.value_or(-1) << " of " << report.energy_most);
            CHECK(report.kinetic_energy > 0.1 * report.energy_most);
            CHECK(report.kinetic_energy == Approx(right.kinetic_energy).epsilon(0.02));
            CHECK(std::abs(report.energy_lost.value()) < 0.04 * report.kinetic_energy);
        }
    }
}
