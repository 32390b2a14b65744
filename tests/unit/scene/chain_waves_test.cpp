// Which chains take substeps for their waves under vertex block descent, and how many.

#include "support/catch.hpp"
#include "support/scenes.hpp"

#include <functional>

using namespace taut;

namespace {

/// Twenty links of 1e5 N/m between vertices of 10 g, held by the first, let go level.
Scene level()
{
    Scene scene = test::chain(20, 1e5, 0.01);
    scene.bodies[0].transform.rotate_axis = {0, 0, 1};
    scene.bodies[0].transform.rotate_degrees = 90;
    scene.method.type = MethodKind::vbd;
    return scene;
}

double substeps_of(Scene scene)
{
    scene.method.substeps = 0;
    return resolve(scene).method.substeps;
}

/// That a chain takes when it hangs plumb, and `change` has been made to its scene.
double plumb(const std::function<void(Scene&)>& change)
{
    Scene scene = level();
    scene.bodies[0].transform.rotate_degrees = 0;
    change(scene);
    return substeps_of(scene);
}

} // namespace

TEST_CASE("under vbd a chain that swings takes the substeps that its waves ask for", "[substeps]")
{
    Scene scene = level();
    // h <= sqrt(0.1 m / k), but that of the twenty links the first has an end that does not give way.
    CHECK(substeps_of(scene) == Approx(1 / 60.0 / std::sqrt(0.1 * 0.01 / 1e5)).epsilon(0.02));
    const double one = substeps_of(scene);
    scene.bodies[0].material.stretch_stiffness *= 25;
    CHECK(substeps_of(scene) == Approx(5 * one).epsilon(0.02)); // as the root of the stiffness
    scene.method.iterations = 4;
    CHECK(substeps_of(scene) == Approx(2.5 * one).epsilon(0.02));
    for (double& m : scene.bodies[0].vertex_masses)
        m *= 6.25;
    CHECK(substeps_of(scene) == Approx(one).epsilon(0.04));
    scene = level();
    scene.bodies[0].vertex_masses.back() = 1; // a bob: waves run in the links
    CHECK(substeps_of(scene) == Approx(one).epsilon(0.04));
    scene.method.type = MethodKind::xpbd;
    const double loaded = substeps_of(scene);
    scene.bodies[0].material.stretch_stiffness *= 100;
    CHECK(substeps_of(scene) == loaded);
}

TEST_CASE("the waves of a chain go by the material where no masses are given", "[substeps]")
{
    Scene scene = level();
    scene.bodies[0].vertex_masses.clear();
    scene.bodies[0].material.density = 0.2;
    scene.bodies[0].material.stretch_stiffness = 8e3; // 200 m/s, 5 cm an edge: 4,000 edges a second
    CHECK(substeps_of(scene) == Approx(4000 / 60.0 / std::sqrt(0.1)).epsilon(0.02));
}

TEST_CASE("springs beside the links, or in their place, carry waves", "[substeps]")
{
    Scene scene = level();
    const double links = substeps_of(scene);
    Body& body = scene.bodies[0];
    body.material.stretch_stiffness = 0;
    for (std::uint32_t k = 0; k < 20; ++k)
        body.springs.push_back({k, k + 1, 0.05, 1e-5});
    CHECK(substeps_of(scene) == links);
    for (Body::Spring& spring : body.springs)
        spring.compliance = 0; // rigid: nothing tells how fast
    CHECK(substeps_of(scene) < links / 2);
}

TEST_CASE("a chain that hangs still takes no substeps for waves, one that something drives does",
          "[substeps]")
{
    const double still = plumb([](Scene&) {}), level_one = substeps_of(level());
    CHECK(still < level_one / 2);
    CHECK(plumb([](Scene& s) { s.bodies[0].material.stretch_stiffness *= 1e4; }) == still);
    CHECK(plumb([](Scene& s) { s.bodies[0].pins.clear(); }) == Approx(still).margin(still / 2));
    const auto swings = [&](const std::function<void(Scene&)>& change) {
        CHECK(plumb(change) == Approx(level_one).epsilon(0.01));
    };
    swings([](Scene& s) { s.bodies[0].velocity = {1, 0, 0}; });
    swings([](Scene& s) { s.bodies[0].pins[0].motion = {Keyframe{}}; });
    swings([](Scene& s) { s.bodies[0].pins[0].moved_by_program = true; });
    swings([](Scene& s) { s.external_forces = true; });
    swings([](Scene& s) { s.gravity = {0, 9.81, 0}; }); // it stands on its pin
    swings([](Scene& s) { s.gravity = {9.81, 0, 0}; });
    swings([](Scene& s) { s.bodies[0].transform.rotate_degrees = 10; });
    swings([](Scene& s) {
        s.bodies[0].start_positions = s.bodies[0].mesh.positions;
        s.bodies[0].start_positions[20].x = 0.1;
    });
    swings([](Scene& s) {
        Collider ball;
        ball.motion = {Keyframe{}};
        s.colliders = {ball};
    });
    CHECK(plumb([](Scene& s) { s.colliders = {Collider{}}; }) == still);
    CHECK(plumb([](Scene& s) { s.gravity = glm::dvec3(0); }) == 10);
}
