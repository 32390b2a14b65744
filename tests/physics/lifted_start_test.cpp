// Bodies that start below the gap that they keep from a collider are lifted out of it, and stay there: a body
// put on a floor "at height 0" must not hop (docs/effects/plane.md).

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

enum class Floor
{
    plane,
    cuboid,
    sphere,
};

/// A box whose lowest corners stand on a floor, so that it is as deep in the gap as that is.
Scene on_a_floor(MethodKind method, double modulus, double size, double gap, Floor kind)
{
    Scene scene;
    scene.method.type = method;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 3, 3};
    body.shape.box_size = glm::dvec3(size);
    body.material = solid_material();
    body.material.youngs_modulus = modulus;
    body.material.density = 1100;
    body.material.thickness = gap;
    body.transform.translate.y = size / 2;
    scene.bodies = {body};
    Collider floor;
    floor.friction = 0.5;
    floor.kind = kind == Floor::plane    ? ColliderKind::plane
                 : kind == Floor::cuboid ? ColliderKind::cuboid
                                         : ColliderKind::sphere;
    if (kind == Floor::cuboid)
    {
        floor.half_size = {1, 0.1, 1};
        floor.point = {0, -0.1, 0};
    }
    if (kind == Floor::sphere) // as good as level
    {
        floor.radius = 100;
        floor.point = {0, -100, 0};
    }
    scene.colliders = {floor};
    return scene;
}

double mean_height(const World& world)
{
    double sum = 0;
    for (const glm::dvec3& x : world.positions())
        sum += x.y;
    return sum / static_cast<double>(world.positions().size());
}

} // namespace

TEST_CASE("what starts in the gap of a floor is lifted out of it and does not hop", "[lifted]")
{
    const MethodKind method = GENERATE(MethodKind::xpbd, MethodKind::vbd, MethodKind::implicit_euler);
    const double modulus = GENERATE(2e6, 1e8), size = GENERATE(0.02, 0.1);
    const auto kind = GENERATE(Floor::plane, Floor::cuboid, Floor::sphere);
    const double gap = GENERATE(1e-3, 4e-3);
    CAPTURE(to_string(method), modulus, size, int(kind), gap);
    World world(on_a_floor(method, modulus, size, gap, kind), test_device("cpu:serial"));
    const double before = mean_height(world);
    double highest = 0;
    for (int frame = 0; frame < 60; ++frame)
    {
        world.step();
        highest = std::max(highest, mean_height(world) - before);
    }
    const double lifted = mean_height(world) - before;
    // It sinks in by its weight, and by what the substeps leave of that (at most 0.15 mm here); a sphere of
    // 100 m bends away by 13 um below the corners of the larger cube.
    CHECK(lifted > gap - 2e-3 * size - 2e-5);
    CHECK(lifted < 1.03 * gap);
    CHECK(highest < 1.3 * gap); // lifted at 0.5 m/s to the end it would go on by up to 13 mm
    CHECK(measure(world).kinetic_energy < 0.01 * 1100 * size * size * size * 9.81 * gap);
}

TEST_CASE("where nothing falls, what starts in a gap is let out at depenetration_speed", "[lifted]")
{
    Scene scene = on_a_floor(MethodKind::xpbd, 1e4, 0.1, 4e-3, Floor::plane);
    scene.gravity = {0, 0, 0};
    scene.method.substeps = 10;
    scene.timestep = 0.01;
    World world(scene, test_device("cpu:serial"));
    world.step();
    double lowest = 1;
    for (const glm::dvec3& x : world.positions())
        lowest = std::min(lowest, x.y);
    CHECK(lowest > 4e-3); // out within 8 ms at 0.5 m/s; braked as on earth that would take 40 ms
    CHECK(lowest < 5e-3);
}
