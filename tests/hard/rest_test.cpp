// Long runs and rest (methods 2.B B16, 2.E E05, 2.G).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

struct RestScene
{
    const char* name;
    Scene scene;
};

/// Cloth at rest without gravity, with more and more effects that have nothing to do.
std::vector<RestScene> scenes_at_rest()
{
    std::vector<RestScene> out;
    Scene scene = free_cloth(6, 1e4, 0);
    const auto add = [&](const char* name) { out.push_back({name, scene}); };
    add("stretch");
    scene.bodies[0].material.bending_stiffness = 1e-3;
    add("stretch, bending");
    scene.bodies[0].pins = {hold({0, 6})};
    add("and pins");
    scene.damping = 0.5;
    scene.external_forces = true;
    add("and damping, forces");
    Collider floor, ball;
    floor.kind = ColliderKind::plane;
    floor.point = {0, 0, -scene.bodies[0].material.thickness};
    floor.normal = {0, 0, 1};
    floor.friction = 0.5;
    ball.point = {0, 0, 2 + scene.bodies[0].material.thickness};
    ball.radius = 2;
    ball.friction = 0.5;
    scene.colliders = {floor, ball};
    add("and a plane and a ball that touch");
    scene.bodies[0].pins[0].motion = {{0, {0, 0, 0}}, {1, {0, 0, 0}}};
    add("and led pins");
    scene.method.iterations = 3;
    add("3 iterations");
    scene = free_cloth(6, kInfinity, 1e-3);
    add("rigid stretch, bending");
    Body chain = particles({{0, 0, 0}, {0, -1, 0}, {0, -2, 0}});
    chain.springs = {{0, 1, 1, 1e-4}, {1, 2, 1, 0}};
    scene = alone(chain);
    add("springs");
    return out;
}

} // namespace

TEST_CASE("B16: what is at rest stays at rest, whatever effects look on [hard]")
{
    const auto cases = scenes_at_rest();
    on_every_device([&](const auto& device) {
        double worst = 0, worst_energy = 0;
        for (const RestScene& rest : cases)
        {
            INFO(rest.name);
            World world(rest.scene, device);
            const auto start = world.positions();
            run(world, steps_for(*device, 1000, 300));
            const StepReport report = check_sound(world);
            const PhysicalModel model = make_model(rest.scene);
            double mass = 0;
            for (const double m : model.mass)
                mass += m;
            const double drift = largest_distance(world.positions(), start) / model.diameter;
            const double kinetic = report.kinetic_energy / (mass * 9.81 * model.diameter);
            worst = std::max(worst, drift);
            worst_energy = std::max(worst_energy, kinetic);
            CHECK(drift < 1e-6);
            CHECK(kinetic < 1e-10);
        }
        note("B16", *device, "e_L", worst);
        note("B16", *device, "kinetic energy / (m g D)", worst_energy);
    });
}

TEST_CASE("100,000 steps at rest: no drift, no creep of energy [hard]")
{
    Scene scene = test::chain(4, 1000, 0.01);
    scene.method.substeps = 4;
    on_every_device([&](const auto& device) {
        const int steps = steps_for(*device, 100000, 2000);
        World world(scene, device);
        world.set_gravity({0, -9.81, 0});
        Scene settling = scene;
        settling.damping = 20;
        World settle(settling, test_device("cpu:serial"));
        run(settle, 1200);
        WorldState rest = settle.state();
        world.restore(rest);
        const auto start = world.positions();
        const double first = energy(world);
        run(world, steps / 2);
        const double middle = energy(world);
        run(world, steps / 2);
        const StepReport report = check_sound(world);
        const double drift = largest_distance(world.positions(), start);
        note("1e5 steps", *device, "drift / D", drift);
        note("1e5 steps", *device, "speed / sqrt(g D)", report.max_speed / std::sqrt(9.81));
        note("1e5 steps", *device, "energy change, first half / (m g D)", (middle - first) / (0.05 * 9.81));
        note("1e5 steps", *device, "energy change, second half / (m g D)",
             (energy(report) - middle) / (0.05 * 9.81));
        CHECK(drift < 1e-6);
        CHECK(report.max_speed / std::sqrt(9.81) < 1e-5);
        CHECK(std::abs(energy(report) - first) / (0.05 * 9.81) < 1e-7);
        CHECK(world.positions()[0] == start[0]);
    });
}

TEST_CASE("E05: cloth on the floor lies still for 30 s [hard]")
{
    Scene scene = free_cloth(6, 1e4, 1e-4);
    scene.gravity = {0, 0, -9.81};
    conformance::Random random(7);
    auto& start = scene.bodies[0].start_positions;
    start = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : start)
        x += glm::dvec3(0, 0, random.uniform(0, 0.01));
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.normal = {0, 0, 1};
    floor.point = {0, 0, -0.01};
    for (const double friction : {0.0, 0.5})
    {
        floor.friction = friction;
        scene.colliders = {floor};
        on_every_device([&](const auto& device) {
            const int seconds = steps_for(*device, 30, 6);
            World world(scene, device);
            run(world, 60 * (seconds - 2));
            const auto before = world.positions();
            double fastest = 0;
            for (int i = 0; i < 12; ++i)
            {
                run(world, 10);
                fastest = std::max(fastest, measure(world).max_speed);
            }
            const double d = std::sqrt(2.0);
            const double jitter = fastest / std::sqrt(9.81 * d),
                         drift = largest_distance(world.positions(), before) / d;
            note("E05", *device, friction > 0 ? "jitter, friction 0.5" : "jitter, no friction", jitter);
            note("E05", *device,
                 friction > 0 ? "drift in 2 s / D, friction 0.5" : "drift in 2 s / D, no friction", drift);
            CHECK(jitter < 1e-3);
            CHECK(drift < 1e-3);
            CHECK(check_sound(world).penetration < 1e-6);
        });
    }
}
