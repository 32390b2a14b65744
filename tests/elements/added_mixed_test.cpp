// Added elements beside springs and hinges of a material, under every method that moves by their energy:
// bodies come to rest where the slope of all energies, by differences in fp64, is nothing.

#include "elements/energies.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/model.hpp"
#include "taut/taut.hpp"

#include <glm/geometric.hpp>

using namespace taut;
using namespace taut::elements_test;

namespace {

/// A cloth of 4 x 4 vertices that bends, held along one side, with rods, areas and springs that are added.
Scene cloth(const std::string& method)
{
    Scene scene;
    scene.timestep = 1.0 / 60;
    scene.duration = 4;
    scene.damping = 6;
    scene.method.type = option_named<MethodKind>(method);
    scene.method.precision = Precision::float64;
    scene.method.substeps = 20;
    if (method == "mass_spring")
        scene.method.stability = StabilityRule::substep;
    if (method == "vbd" || method == "xpbd")
        scene.method.iterations = 4;
    Body body;
    body.shape.kind = ShapeKind::grid;
    body.shape.cells = {3, 3};
    body.shape.size = {1, 1};
    body.material.stretch_stiffness = 200;
    body.material.bending_stiffness = 0.01;
    body.material.density = 0.5;
    Pin pin;
    pin.vertices = {0, 1, 2, 3};
    body.pins.push_back(pin);
    for (std::uint32_t column = 0; column < 4; ++column)
        for (std::uint32_t row = 0; row < 2; ++row)
        {
            const std::uint32_t from = 4 * row + column;
            body.elements.push_back({"thin_rod", {from, from + 4, from + 8}, {8}});
        }
    body.elements.push_back({"held_area", {4, 5, 8, 6, 7, 11}, {0.06, 1e-3, 0.06, 1e-3}});
    body.elements.push_back({"cubic_spring", {8, 13, 11, 14}, {0.4, 1e-4, 0.4, 1e-4}});
    scene.bodies.push_back(body);
    return scene;
}

/// N, the largest force that is left on a vertex that moves.
double largest_force(const PhysicalModel& model, std::vector<glm::dvec3> x)
{
    const double step = 1e-5;
    double most = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        glm::dvec3 slope(0);
        for (int axis = 0; axis < 3; ++axis)
        {
            const double place = x[v][axis];
            x[v][axis] = place + step;
            const double above = elastic_energy(model, x) + gravity_energy(model, x);
            x[v][axis] = place - step;
            slope[axis] = (above - elastic_energy(model, x) - gravity_energy(model, x)) / (2 * step);
            x[v][axis] = place;
        }
        if (!model.pinned[v])
            most = std::max(most, glm::length(slope));
    }
    return most;
}

} // namespace

TEST_CASE("cloth with added elements comes to rest where no force is left, under every method of energies")
{
    add_elements();
    const std::string method = GENERATE("xpbd", "mass_spring", "implicit_euler", "vbd");
    CAPTURE(method);
    const Scene scene = resolve(cloth(method));
    World world(scene, test_device("cpu:serial"));
    while (world.time() < scene.duration)
        world.step();
    const PhysicalModel model = make_model(scene);
    REQUIRE(model.added.size() == 12);
    double weight = 0;
    for (std::size_t v = 0; v < model.mass.size(); ++v)
        weight = std::max(weight, model.mass[v] * 9.81);
    CHECK(largest_force(model, world.positions()) < 0.01 * weight);
    // The added elements matter: without them forces of more than a vertex's weight are left here.
    PhysicalModel without = model;
    without.added.clear();
    CHECK(largest_force(without, world.positions()) > weight);
}

TEST_CASE("cloth with added elements moves with the same bits on every executor")
{
    add_elements();
    const std::string method = GENERATE("xpbd", "pbd", "mass_spring", "implicit_euler", "vbd");
    CAPTURE(method);
    Scene scene = cloth(method);
    scene.method.precision = Precision::float32;
    scene.method.substeps = 2;
    if (method == "implicit_euler")
        scene.method.linear_operator = LinearOperator::matrix_free;
    std::vector<glm::dvec3> first;
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        World world(resolve(scene), test_device(selector));
        for (int frame = 0; frame < 5; ++frame)
            world.step();
        const std::vector<glm::dvec3> x = world.positions();
        first = first.empty() ? x : first;
        CHECK(x == first);
    }
}
