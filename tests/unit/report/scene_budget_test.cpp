// Bodies that cannot meet have nothing to give each other.

#include "support/catch.hpp"

#include "taut/report/report.hpp"
#include "taut/report/scene_budget.hpp"
#include "taut/world/world.hpp"

using namespace taut;

namespace {

/// Two free squares of cloth side by side; the first is thrown up at 10 m/s, 10 J, and the second is not.
Scene thrown_and_still(bool meet)
{
    Body thrown, still;
    thrown.shape.cells = still.shape.cells = {2, 2};
    thrown.velocity = {0, 10, 0};
    still.transform.translate = {3, 0, 0};
    Scene scene;
    scene.gravity = glm::dvec3(0);
    scene.contact.between = meet;
    scene.bodies = {thrown, still};
    return resolve(scene);
}

/// As if the second had half the speed of the first, from nowhere.
Soundness with_speed_of_second(const Scene& scene)
{
    World world(scene, Device::open("cpu:serial"));
    const SceneBudget budget(world.scene());
    world.step();
    std::vector<glm::dvec3> v = world.velocities();
    for (std::size_t i = 9; i < 18; ++i)
        v[i] = {0, 5, 0};
    World other(scene, Device::open("cpu:serial"));
    other.set_velocities(v);
    WorldState moved = other.state();
    moved.kick = 0; // nobody is to know where it came from
    other.restore(moved);
    other.step();
    return judge(budget, other, Judged::motion);
}

} // namespace

TEST_CASE("what one body was thrown with hides nothing of another that it cannot meet")
{
    CHECK(with_speed_of_second(thrown_and_still(false)).status == Status::diverged);
    const Soundness together = with_speed_of_second(thrown_and_still(true));
    CHECK(together.sound());
    CHECK(together.energy_most == Approx(10));
}

TEST_CASE("energies of all parts are reported together")
{
    const Scene scene = thrown_and_still(false);
    World world(scene, Device::open("cpu:serial"));
    world.step();
    const SceneBudget budget(world.scene());
    CHECK(budget.parts() == 2);
    const Soundness found = judge(budget, world);
    CHECK(found.sound());
    CHECK(found.energy == Approx(10).epsilon(1e-5));
    CHECK(found.energy_most == Approx(10).epsilon(1e-5));
    CHECK(SceneBudget(thrown_and_still(true)).parts() == 1);
}

TEST_CASE("what is wrong is said of a body")
{
    const Soundness found = with_speed_of_second(thrown_and_still(false));
    CHECK_THAT(found.reason, Contains("of bodies[1]: the kinetic energy is"));
}

TEST_CASE("a particle beside cloth is judged by what is small for the scene")
{
    Body cloth, particle;
    cloth.shape.cells = {2, 2};
    particle.shape.kind = ShapeKind::chain;
    particle.shape.links = 0;
    particle.transform.translate = {3, 1e-9, 0};
    Collider floor;
    floor.kind = ColliderKind::plane;
    Scene scene;
    scene.bodies = {cloth, particle};
    scene.colliders = {floor};
    scene.bodies[0].transform.translate = {0, 5, 0};
    World world(resolve(scene), Device::open("cpu:serial"));
    const SceneBudget budget(world.scene());
    for (int frame = 0; frame < 20; ++frame)
    {
        world.step();
        CHECK(judge(budget, world).sound());
    }
}

TEST_CASE("cells that a floor has pushed last are no energy from nowhere, of one body and of several")
{
    Body box;
    box.shape.kind = ShapeKind::box;
    box.shape.box_cells = {3, 3, 3};
    box.material = solid_material();
    box.material.youngs_modulus = 1e9;
    Scene scene;
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -0.5, 0};
    scene.colliders = {floor};
    const auto judged = [&](std::size_t bodies, double from) { // squeezed by 2 % over one cell from there, m
        scene.bodies.assign(bodies, box);
        for (std::size_t b = 0; b < bodies; ++b)
            scene.bodies[b].transform.translate = {3.0 * double(b), 0, 0};
        scene = resolve(scene);
        const SceneBudget budget(scene);
        Scene squeezed = scene;
        for (Body& body : squeezed.bodies)
        {
            body.start_positions = body.mesh.positions;
            for (glm::dvec3& p : body.start_positions)
                p.y -= 0.02 * std::clamp(p.y + 0.5 - from, 0.0, 1.0 / 3);
        }
        return judge(budget, World(squeezed, Device::open("cpu:serial")), Judged::state).status;
    };
    for (const std::size_t bodies : {1u, 2u})
    {
        CHECK(judged(bodies, 0) == Status::completed);
        CHECK(judged(bodies, 1.0 / 3) == Status::unconverged);
    }
}
