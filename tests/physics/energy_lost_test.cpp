// Energy that a run has lost (report/energy_lost.hpp), and how little of it stiff cloth loses that swings
// with the iterations and substeps that it takes by itself (docs/methods.md).

#include "hard/cases.hpp"

#include "taut/report/energy_lost.hpp"
#include "taut/scene/kinds.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// A square of 1 m and 0.2 kg held by an edge, 10 degrees below level, of 1e5 N/m.
Scene let_go(MethodKind method)
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.cells = {6, 6};
    body.material.stretch_stiffness = 1e5;
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -80;
    body.pins.emplace_back().edges = {"top"};
    scene.method.type = method;
    if (method == MethodKind::mass_spring)
        scene.method.stability = StabilityRule::substep;
    return scene;
}

StepReport after(const Scene& scene, double seconds)
{
    World world(resolve(scene), test_device("cpu:serial"));
    while (world.time() < seconds)
        world.step();
    return measure(world);
}

double share_lost(const Scene& scene)
{
    const StepReport report = after(scene, 0.6); // past the lowest point, where it is fastest
    REQUIRE(report.energy_lost);
    REQUIRE(report.kinetic_energy > 0.1);
    return lost_share(*report.energy_lost, report.kinetic_energy, report.energy_most);
}

} // namespace

TEST_CASE(
    "methods that keep energy lose none of a swing, and the others little with what they take by themselves")
{
    CHECK(std::abs(share_lost(let_go(MethodKind::mass_spring))) < 0.002);
    CHECK(std::abs(share_lost(let_go(MethodKind::implicit_constraints))) < 0.01);
    for (const MethodKind method : {MethodKind::implicit_euler, MethodKind::vbd})
    {
        INFO(to_string(method));
        const double taken = share_lost(let_go(method)); // 0.09 and 0.08
        CHECK(taken > 0.01);                             // implicit Euler's own damping
        CHECK(taken < 0.13);
    }
    Scene once = let_go(MethodKind::implicit_euler);
    once.method.iterations = 1;
    CHECK(share_lost(once) > 0.25); // 0.3: a Newton step is a straight line
}

TEST_CASE("energy is lost to what a scene has for it")
{
    Scene scene = let_go(MethodKind::mass_spring);
    CHECK(energy_takers(resolve(scene)).empty());
    scene.damping = 2;
    // d(log E)/dt is -2 c of the kinetic part: after 0.6 s most of what was set free has gone.
    const double damped = share_lost(scene);
    CHECK(damped > 0.3);
    CHECK(damped < 1 - std::exp(-2 * 2 * 0.6));
    scene.bodies[0].material.stretch_damping = 1e-4;
    scene.bodies[0].material.drag = 1;
    scene.bodies[0].material.plastic_yield = 0.5;
    scene.wind.density = 1.2;
    scene.colliders.emplace_back().point = {0, 5, 0};
    scene.contact.thickness = 0;
    scene.max_speed = 100;
    CHECK(energy_takers(scene) == std::vector<std::string_view>{"damping", "stretch_damping", "air",
                                                                "colliders", "plasticity", "max_speed"});
    scene.bodies[0].contact.self = true;
    CHECK(energy_takers(resolve(scene)).at(4) == "contact");
}

TEST_CASE("energy that is lost is not told of what more than gravity drives")
{
    const auto told = [](Scene scene) { return after(scene, 0.05).energy_lost.has_value(); };
    Scene scene = let_go(MethodKind::xpbd);
    CHECK(told(scene));
    scene.gravity = glm::dvec3(0);
    CHECK(told(scene));
    scene.bodies[0].pins[0].motion = {{0}, {1, {0, 0, 1}}};
    CHECK_FALSE(told(scene));
    scene.bodies[0].pins[0].motion.clear();
    scene.wind.density = 1.2;
    scene.wind.velocity = {0, 0, 5};
    scene.bodies[0].material.drag = 1;
    CHECK_FALSE(told(scene));
    CHECK_FALSE(told(let_go(MethodKind::pbd)));
    Scene gas;
    gas.bodies.emplace_back().shape =
        shapes::Mesh{.file = TAUT_SOURCE_DIR "/examples/scenes/shapes/sphere.obj"};
    gas.bodies[0].material.stretch_stiffness = 1000;
    CHECK(told(gas));
    gas.bodies[0].material.pressure = 20;
    CHECK_FALSE(told(gas));
    World pushed(resolve(let_go(MethodKind::xpbd)), test_device("cpu:serial"));
    pushed.set_velocities(std::vector<glm::dvec3>(pushed.positions().size(), {0, 0, 1}));
    pushed.step();
    CHECK_FALSE(measure(pushed).energy_lost);
}
