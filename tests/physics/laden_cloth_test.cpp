// A solid on cloth on something that does not give way (docs/contact.md, "Pushing"): with the sweeps that a
// scene takes by itself the cloth is not pressed through either.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sheets.hpp"
#include "support/thrown_run.hpp"

#include "taut/plan/material.hpp"
#include "taut/scene/scene.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <numeric>

using namespace taut;

namespace {

constexpr double kGravity = 9.81, kRadius = 0.003, kSize = 0.1;

Body block(double density)
{
    Body body;
    body.name = "block";
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {4, 4, 4};
    body.shape.box_size = glm::dvec3(kSize);
    body.material = solid_material();
    body.material.youngs_modulus = 2e5;
    body.material.density = density;
    body.material.thickness = kRadius;
    body.transform.translate = {0, 0.075, 0}; // 9 mm above the cloth, but for the gap
    return body;
}

/// A block above cloth of 0.2 kg/m^2, which lies on a mesh that stands still, the first body, or on a plane.
Scene laden(double density, bool on_mesh)
{
    Scene scene;
    Body cloth = test::level_sheet(12, 0.4, {0.02, 0.01, 0.01}, kRadius);
    cloth.material.density = 0.2;
    cloth.material.bending_stiffness = 1e-4;
    cloth.contact.self = true;
    scene.contact.between = true;
    scene.contact.friction = 0.4;
    if (on_mesh)
    {
        scene.bodies.push_back(test::level_sheet(6, 2, {0, 0, 0}, kRadius));
        scene.bodies[0].kinematic.used = true;
    }
    else
    {
        Collider plane;
        plane.kind = ColliderKind::plane;
        plane.friction = 0.4;
        scene.colliders = {plane};
    }
    scene.bodies.push_back(cloth);
    scene.bodies.push_back(block(density));
    return scene;
}

double mass_of(const Body& body)
{
    const auto masses = vertex_masses(body);
    return std::accumulate(masses.begin(), masses.end(), 0.0);
}

/// N, downwards, with which the `above`th body presses on the `below`th.
double pressed(const World& world, std::size_t below, std::size_t above)
{
    double force = 0;
    for (const auto& of : world.contact_forces())
        if (of.a == below && of.b == above)
            force -= of.force.y;
    return force;
}

} // namespace

TEST_CASE("a block that drops onto cloth on a floor lies on it, and crosses neither")
{
    const bool on_mesh = GENERATE(true, false);
    const std::string method = GENERATE("xpbd", "vbd", "implicit_euler");
    const double density = GENERATE(200.0, 2000.0);
    CAPTURE(on_mesh, method, density);
    Scene scene = laden(density, on_mesh);
    scene.damping = 2;
    scene.method.type = option_named<MethodKind>(method);
    World world(resolve(scene), test_device("cpu:serial"));
    const test::Meant meant(world.scene());
    const judging::Judge judge(meant.all.triangles, world.positions());
    std::size_t crossed = 0;
    for (int step = 0; step < 60; ++step)
    {
        world.step();
        crossed += test::met_between(meant, judge, world.positions(), world.positions());
    }
    CHECK(crossed == 0);
    const auto positions = world.positions();
    const std::size_t first = positions.size() - 125;
    double middle = 0;
    for (std::size_t v = first; v < positions.size(); ++v)
        middle += positions[v].y / 125;
    // The plane keeps one radius, a mesh two; the block lies two above the cloth, and gives way a little.
    const double bottom = (on_mesh ? 4 : 3) * kRadius;
    CHECK(middle > bottom + kSize / 2 - 0.002);
    CHECK(middle < bottom + kSize / 2 + 0.001);
    const std::size_t cloth = on_mesh ? 1 : 0;
    const double weight = mass_of(world.scene().bodies[cloth + 1]) * kGravity;
    CHECK(pressed(world, cloth, cloth + 1) == Approx(weight).epsilon(0.02));
}

TEST_CASE("sweeps that nobody names follow from what a solid weighs on the lightest cloth that it may meet")
{
    CHECK(resolve(laden(2, true)).contact.sweeps == 8);
    CHECK(resolve(laden(200, true)).contact.sweeps == 20);  // 2 sqrt(200 * 0.1 / 0.2)
    CHECK(resolve(laden(2000, true)).contact.sweeps == 64); // 2 sqrt(1000) = 63.2
    CHECK(resolve(laden(2e4, true)).contact.sweeps == 100); // no more
    Scene apart = laden(2000, true);
    apart.bodies[1].contact.group = "cloth";
    apart.bodies[2].contact.passes = {"cloth"};
    CHECK(resolve(apart).contact.sweeps == 8);
    Scene led = laden(2000, true);
    led.bodies[2].kinematic.used = true;
    CHECK(resolve(led).contact.sweeps == 2);
    Scene without = laden(2000, true);
    without.bodies.pop_back();
    CHECK(resolve(without).contact.sweeps == 2);
    Scene heavier = laden(200, true); // four times the mass, by vertices
    heavier.bodies[2].vertex_masses.assign(125, 4 * 0.2 / 125);
    CHECK(resolve(heavier).contact.sweeps == 40);
    Scene named = laden(2000, true);
    named.contact.sweeps = 3;
    CHECK(resolve(named).contact.sweeps == 3);
}
