// Damping takes energy out for good: what still moves after it has taken more than there was is energy from
// nowhere, though there was never more of it at once than at the start.

#include "hard/cases.hpp"

#include "taut/report/soundness_watch.hpp"

namespace taut::hard {
namespace {

/// Crumpled cloth, free of all forces. Explicit steps make energy of what is so far from its shape.
Scene crumpled(double damping)
{
    Scene scene;
    Body body;
    body.shape.cells = {8, 8};
    body.material.density = 0.2;
    body.material.stretch_stiffness = 1000;
    body.material.bending_stiffness = 0.05;
    conformance::Random random(3);
    for (int k = 0; k < 81; ++k)
        body.start_positions.push_back(
            {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)});
    scene.bodies = {body};
    scene.gravity = glm::dvec3(0);
    scene.damping = damping;
    return scene;
}

Soundness watched(const Scene& scene, std::uint64_t frames)
{
    World world(scene, test_device("cpu:serial"));
    SoundnessWatch watch(frames);
    for (std::uint64_t k = 1; k <= frames && watch.found().sound(); ++k)
    {
        world.step();
        watch.after(k, world);
    }
    return watch.found();
}

} // namespace

TEST_CASE("damping does not hide that explicit steps make energy [hard]")
{
    Scene scene = crumpled(4);
    scene.method.type = MethodKind::mass_spring;
    scene.method.stability = StabilityRule::substep;
    const Soundness found = watched(resolve(scene), 360);
    INFO(found.reason);
    CHECK(found.status == Status::diverged);
}

TEST_CASE("what is damped to rest is sound all the way [hard]")
{
    for (const char* method : {"vbd", "implicit_euler", "xpbd"})
        for (const double damping : {0.1, 1.0, 4.0})
        {
            Scene scene = crumpled(damping);
            scene.method.type = option_named<MethodKind>(method);
            scene.method.substeps = 40;
            const Soundness found = watched(resolve(scene), 120);
            INFO(method << ", " << damping << " /s: " << found.reason);
            CHECK(found.sound());
            Scene hung = test::hanging(8); // it swings
            hung.bodies[0].transform.rotate_axis = {1, 0, 0};
            hung.bodies[0].transform.rotate_degrees = -90;
            hung.damping = damping;
            hung.method.type = option_named<MethodKind>(method);
            hung.method.substeps = 10;
            CHECK(watched(resolve(hung), 240).sound());
        }
}

} // namespace taut::hard
