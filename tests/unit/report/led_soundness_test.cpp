// The bound of energies beside what is led.

#include "support/catch.hpp"

#include "taut/report/report.hpp"

using namespace taut;

namespace {

/// A square of cloth that falls, 0.2 kg, and a kinematic plate of 1,000 kg beside it, which moves by `way` in
/// a second.
Scene cloth_and_plate(const glm::dvec3& way, const glm::dvec3& first = glm::dvec3(0))
{
    Body cloth, plate;
    cloth.shape.cells = plate.shape.cells = {1, 1};
    plate.transform.translate = {5, 0, 0};
    plate.kinematic.used = true;
    plate.kinematic.motion = {{0, first}, {1, first + way}};
    plate.material.density = 1000;
    Scene scene;
    scene.contact.between = true;
    scene.bodies = {cloth, plate};
    return resolve(scene);
}

/// After a second of free fall, `times` as fast as it must be.
Soundness after_a_fall(const Scene& scene, const glm::dvec3& way, double times = 1)
{
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(4, {0, -9.81 * times, 0});
    for (glm::dvec3& p : x)
        p.y -= 0.5 * 9.81;
    for (const glm::dvec3& p : scene.bodies[1].mesh.positions)
        x.push_back(p + way);
    v.resize(8, glm::dvec3(0));
    return judge_motion(EnergyBudget(scene),
                        {scene, x, v, {1, 1.0 / 600, 9.81, true, 0}, Precision::float32, {}, 0});
}

} // namespace

TEST_CASE("the weight of what is led is no energy of what falls beside it")
{
    for (const double way : {1.0, -1.0}) // 9.8 kJ, beside 9.6 J of the fall
    {
        const Soundness fall = after_a_fall(cloth_and_plate({0, way, 0}), {0, way, 0});
        CHECK(fall.sound());
        CHECK(fall.energy_most < 100);
    }
}

TEST_CASE("a kinematic body lends speed only where its way comes near")
{
    const glm::dvec3 away(40, 0, 0), near(-40, 0, 0); // through the cloth, at 40 m/s
    CHECK(after_a_fall(cloth_and_plate(away), away, 2).status == Status::diverged);
    CHECK(after_a_fall(cloth_and_plate(near), near, 2).sound());
}

TEST_CASE("where a kinematic body starts is no way that it has gone")
{
    const glm::dvec3 first(-5, 0, 0); // from its mesh to the cloth
    const Soundness fall = after_a_fall(cloth_and_plate({0, 0.01, 0}, first), first, 2);
    CHECK(fall.status == Status::diverged);
    CHECK(fall.energy_most < 15); // with 5 m of way it would be 19
}

TEST_CASE("a pin that takes its vertices elsewhere at time 0 gives the energy of that jump")
{
    Body cloth;
    cloth.shape.cells = {1, 1};
    Pin pin;
    pin.corners = {"top_left"};
    pin.motion = {{0, {0.1, 0, 0}}};
    cloth.pins = {pin};
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.bodies = {cloth};
    scene = resolve(scene);
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(4, {1, 0, 0});
    const RunState state{scene, x, v, {1, 1.0 / 600, 0, true, 0}, Precision::float32, {}, 0};
    CHECK(judge_motion(EnergyBudget(scene), state).sound());
    scene.bodies[0].pins[0].motion[0].translate = {0, 0, 0};
    CHECK(judge_motion(EnergyBudget(scene), state).status == Status::diverged);
}
