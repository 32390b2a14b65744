// The bound of energies beside what is led.

#include "support/catch.hpp"

#include "taut/report/report.hpp"

using namespace taut;

TEST_CASE("what is led lends no weight to what falls, and takes none from it")
{
    Body cloth;
    cloth.shape.cells = {1, 1};
    Scene scene;
    scene.bodies = {cloth};
    scene = resolve(scene);
    Body plate = scene.bodies[0];
    plate.kinematic.used = true;
    plate.kinematic.motion = {{0, {0, 0, 0}}, {1, {0, 100, 0}}};
    plate.pins = {Pin{}};
    plate.pins[0].vertices = {0, 1, 2, 3};
    REQUIRE(plate.mesh.positions.size() == 4);
    plate.pins[0].motion = plate.kinematic.motion;
    plate.material.density = 1000;
    scene.bodies.push_back(plate);
    const EnergyBudget budget(scene);
    for (const double way : {100.0, -100.0}) // of the plate
    {
        std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(4, {0, -9.81, 0});
        for (glm::dvec3& p : x)
            p.y -= 0.5 * 9.81;
        for (const glm::dvec3& p : plate.mesh.positions)
            x.push_back(p + glm::dvec3(0, way, 0));
        v.resize(8, glm::dvec3(0));
        const Soundness fall =
            judge_motion(budget, {scene, x, v, {1, 1.0 / 600, 9.81, true, 0}, Precision::float32, {}, 0});
        CHECK(fall.sound());
        CHECK(fall.energy_most < 1e6); // 9.8e8 J with the plate's weight
    }
}
