// Hinges of position-based dynamics at the edge of what is held.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// A square of cloth in the xy plane, held by an edge, without gravity; its drift is 0.1 m/s along z. In a
/// grid of alternating diagonals some hinges have both wings and one end of the edge held, the other end in
/// line with both: what moves has hardly a part in their angle.
Scene held_by_an_edge(std::uint32_t cells, const char* edge, const char* scheme, const char* precision)
{
    Scene scene;
    Body body;
    body.shape.cells = {cells, cells};
    body.material.bending_stiffness = 1;
    Pin pin;
    pin.edges = {edge};
    body.pins = {pin};
    body.velocity = {0, 0, 0.1};
    scene.bodies = {body};
    scene.gravity = glm::dvec3(0);
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = option_named<ElementScheme>(scheme);
    scene.method.precision = option_named<Precision>(precision);
    return scene;
}

/// Lowest vertex of a level sheet, held by an edge, after a second, m.
double sag(double bend)
{
    Scene scene = held_by_an_edge(6, "top", "coloured", "float");
    scene.bodies[0].velocity = glm::dvec3(0);
    scene.gravity = {0, 0, -9.81};
    scene.method.bend = bend;
    World world(scene, test_device("cpu:serial"));
    run(world, 60);
    double lowest = 0;
    for (const glm::dvec3& x : world.positions())
        lowest = std::min(lowest, x.z);
    return lowest;
}

} // namespace

TEST_CASE("hinges whose wings are held make no energy, in any scheme and precision")
{
    const std::uint32_t cells = GENERATE(3u, 8u, 13u);
    const char* edge = GENERATE("top", "left");
    for (const char* scheme : kPbdSchemes)
        for (const char* precision : {"float", "double"})
        {
            CAPTURE(cells, edge, scheme, precision);
            World world(held_by_an_edge(cells, edge, scheme, precision), test_device("cpu:serial"));
            const double start = measure(world).kinetic_energy;
            double most = 0;
            for (int step = 0; step < 30; ++step)
            {
                world.step();
                most = std::max(most, measure(world).kinetic_energy);
            }
            REQUIRE(start > 1e-4);
            CHECK(most < 2 * start);   // hinges that are still bent from the step before give some back
            CHECK(most > 0.2 * start); // it swings, and is not stopped
        }
}

TEST_CASE("hinges at a held edge still carry a sheet that sticks out level")
{
    const double stiff = sag(1), limp = sag(0);
    CAPTURE(stiff, limp);
    CHECK(limp < -0.2);
    CHECK(stiff > 0.5 * limp);
}
