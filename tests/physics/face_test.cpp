// Claims about colliders that stand between the vertices of a body: its triangles hold them, under every
// method.

#include "hard/cases.hpp"
#include "support/methods.hpp"
#include "support/random.hpp"
#include "support/sheets.hpp"
#include "support/tilted_block.hpp"

#include "taut/report/crossing.hpp"
#include "taut/report/crossing_shapes.hpp"
#include "taut/report/holes.hpp"

#include <algorithm>
#include <array>

using namespace taut;
using namespace taut::hard;

namespace {

constexpr double kThickness = 0.005; // m, what the sheets keep from colliders

Collider ball(double radius)
{
    Collider out;
    out.kind = ColliderKind::sphere;
    out.radius = radius;
    return out;
}

Collider rod(const glm::dvec3& from, const glm::dvec3& to, double radius)
{
    Collider out;
    out.kind = ColliderKind::capsule;
    out.point = from;
    out.end = to;
    out.radius = radius;
    return out;
}

Collider box(const glm::dvec3& half, const glm::dvec3& axis = {0, 1, 0}, double degrees = 20)
{
    Collider out;
    out.kind = ColliderKind::cuboid;
    out.half_size = half;
    out.rotate_axis = axis;
    out.rotate_degrees = degrees;
    return out;
}

/// A sheet of a metre that falls from 5 cm above what reaches up to `top`.
Scene draped(const Collider& collider, double top, std::uint32_t cells)
{
    Scene scene;
    scene.bodies = {test::level_sheet(cells, 1, {0.04, top + 0.05, 0.03}, kThickness)};
    scene.bodies[0].material.bending_stiffness = 1e-4;
    scene.colliders = {collider};
    scene.colliders[0].friction = 0.5;
    scene.damping = 1;
    return scene;
}

/// m: how far the deepest point of any triangle lies below any collider, moved out by `gap`.
double deepest(const World& world, double gap)
{
    double out = 0;
    const std::vector<glm::dvec3> x = world.positions();
    for (const Collider& collider : world.scene().colliders)
    {
        Collider grown = collider;
        grown.radius += gap;
        grown.half_size += gap;
        const SolidShape shape = solid_shape(grown);
        const ColliderFrame frame = frame_at(collider, world.time());
        for (const auto& [a, b, c] : world.scene().bodies[0].mesh.triangles)
            out =
                std::max(out, depth_of(shape, {frame.inside(x[a]), frame.inside(x[b]), frame.inside(x[c])}));
    }
    return out;
}

std::vector<std::pair<std::string, Scene>> drapes()
{
    return {{"a ball", draped(ball(0.08), 0.08, 4)},
            {"the end of a rod", draped(rod({0, -1, 0}, {0, 0, 0}, 0.02), 0.02, 6)},
            {"a rail", draped(rod({-0.6, 0, 0}, {0.6, 0, 0.1}, 0.01), 0.01, 6)},
            {"the corner of a box", draped(box({0.05, 0.05, 0.05}, {1, 0, -1}, 54.7356), 0.0866, 4)},
            {"the edge of a box", draped(box({0.6, 0.05, 0.05}, {1, 0, 0}, 45), 0.0707, 5)},
            {"a table", draped(box({0.3, 0.1, 0.3}), 0.1, 8)},
            {"a post", draped(box({0.02, 0.5, 0.02}), 0.5, 5)}};
}

struct Depths
{
    double solid = 0; ///< m, below the collider
    double kept = 0;  ///< m, below where the thickness ends
};

Depths deepest_in(World& world, int steps)
{
    Depths out;
    for (int k = 0; k < steps; ++k)
    {
        world.step();
        out.solid = std::max(out.solid, deepest(world, 0));
        out.kept = std::max(out.kept, deepest(world, kThickness));
    }
    return out;
}

/// A block on a post of 20 cm; its corners hang over on all sides.
Scene block_on_post(double degrees, double friction)
{
    Scene scene;
    scene.bodies = {test::tilted_block(degrees, 3)};
    scene.colliders = {test::tilted_post(degrees, {0, 0, 0}, {0.1, 0.1, 0.1}, friction)};
    return scene;
}

glm::dvec3 mean_place(const World& world)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& x : world.positions())
        sum += x;
    return sum / static_cast<double>(world.positions().size());
}

} // namespace

TEST_CASE("what would fit through triangles is held up by them, under every method", "[face]")
{
    for (const auto& [name, scene] : drapes())
        for (const std::string_view method : kWords<MethodKind>)
        {
            CAPTURE(name, method);
            World world(test::under(scene, std::string(method)), test_device("cpu:serial"));
            const Depths found = deepest_in(world, 60);
            CHECK(found.solid == 0);
            CHECK(found.kept < 0.3 * kThickness);
            check_sound(world);
        }
}

TEST_CASE("without triangles it comes through between vertices", "[face]")
{
    for (auto [name, scene] : drapes())
    {
        CAPTURE(name);
        scene.colliders[0].meets = ColliderMeets::vertices;
        World world(scene, test_device("cpu:serial"));
        CHECK(deepest_in(world, 60).solid > 0.9 * kThickness);
    }
}

TEST_CASE("cloths that are thrown at colliders which may move and turn do not end in them", "[face]")
{
    conformance::Random random(77);
    for (int n = 0; n < 60; ++n)
    {
        const double size = random.uniform(0.01, 0.15), length = random.uniform(0.05, 0.6);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)));
        const glm::dvec3 half(random.uniform(0.01, 0.3), random.uniform(0.01, 0.3),
                              random.uniform(0.01, 0.3));
        const Collider shapes[] = {ball(size), rod(-axis * length, axis * length, 0.5 * size),
                                   box(half, axis, random.uniform(0, 360))};
        Scene scene = draped(shapes[n % 3], 0.6, 3 + random.below(6));
        scene.bodies[0].velocity = {random.uniform(-1, 1), random.uniform(-4, 0), random.uniform(-1, 1)};
        Collider& collider = scene.colliders[0];
        collider.friction = random.uniform(0, 1);
        collider.meets = ColliderMeets::surface;
        if (random.chance(0.5))
        {
            Keyframe end{1, {random.uniform(-1, 1), random.uniform(-1, 1), 0}};
            end.rotate_axis = axis;
            end.rotate_degrees = random.uniform(-180, 180);
            collider.motion = {Keyframe{0, {0, 0, 0}}, end};
        }
        const std::string method = std::array{"xpbd", "vbd", "implicit_euler"}[std::size_t(n / 3 % 3)];
        CAPTURE(n, method, size, scene.bodies[0].shape.cells.x);
        World world(test::under(scene, method), test_device("cpu:serial"));
        CHECK(deepest_in(world, 90).solid == 0);
    }
}

TEST_CASE("a block whose corners hang over on all sides slides down a tilted post as friction says", "[face]")
{
    const double friction = GENERATE(0.0, 0.2, 0.3, 0.5);
    CAPTURE(friction);
    World world(block_on_post(20, friction), test_device("cpu:serial"));
    run(world, 6); // it lands, and goes on sliding
    const double early = glm::length(test::mean_velocity(world));
    run(world, 12);
    const double late = glm::length(test::mean_velocity(world)), tilt = glm::radians(20.0);
    const double gain = 9.81 * (std::sin(tilt) - friction * std::cos(tilt)) * 12 / 60.0;
    if (gain > 0)
        CHECK(late - early == Approx(gain).epsilon(0.03));
    else
    {
        run(world, 72); // it has stopped to ring
        const glm::dvec3 there = mean_place(world);
        run(world, 60);
        CHECK(glm::distance(mean_place(world), there) < 2e-4);
    }
    CHECK(deepest(world, 0) < 1e-3);
}
