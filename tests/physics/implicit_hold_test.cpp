// Claims about a light vertex between a collider and a heavy body, under implicit_euler.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("a heavy vertex stands on a light one where statics says", "[implicit_euler]")
{
    constexpr double kWeight = 1 * 9.81, kCompliance = 1e-3; // N, m/N
    on_every_device([](const auto& device) {
        for (const double ratio : {1e3, 1e5})
        {
            Body stilt = particles({{0, 0, 0}, {0, 1, 0}});
            stilt.vertex_masses = {1 / ratio, 1};
            stilt.springs = {{0, 1, 1.0, kCompliance}};
            Scene scene = alone(stilt);
            scene.gravity = {0, -9.81, 0};
            scene.damping = 4;
            Collider floor;
            floor.kind = ColliderKind::plane;
            scene.colliders = {floor};
            scene.method.type = MethodKind::implicit_euler;
            scene.method.iterations = 3;
            World world(scene, device);
            run(world, 120);
            const auto x = world.positions();
            const double short_by = 1 - glm::distance(x[0], x[1]);
            INFO(ratio << ": the light one at " << x[0].y << " m, the spring shorter by " << short_by);
            note("physics", *device, "stilt on a light foot, error of its strain",
                 short_by / (kWeight * kCompliance) - 1);
            CHECK(short_by == Approx(kWeight * kCompliance).epsilon(0.02));
        }
    });
}
