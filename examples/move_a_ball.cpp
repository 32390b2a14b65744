// A ball that the program moves through hanging cloth. It decides the path while it runs: the ball goes for
// the middle of the cloth, and turns back once it has pushed that far enough.
#include <taut/taut.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

int main()
{
    taut::Body cloth; // 1 m by 1 m in the plane z = 0, held by its upper edge
    cloth.shape.cells = {32, 32};
    cloth.pins.resize(1);
    cloth.pins[0].edges = {"top"};
    taut::Collider ball; // at rest 0.6 m in front of it; colliders without keyframes may be moved
    ball.point = {0, -0.1, 0.6};
    ball.radius = 0.2;
    ball.friction = 0.3;
    taut::Scene scene;
    scene.bodies = {cloth};
    scene.colliders = {ball};
    taut::World world(scene, taut::Device::open());

    const double speed = 1.5; // m/s
    double z = 0, furthest = 0, turned_at = 0;
    bool forth = true;
    while (world.time() < 3)
    {
        for (const glm::dvec3& x : world.positions(0))
            furthest = std::min(furthest, x.z);
        if (forth && furthest < -0.4)
        {
            forth = false;
            turned_at = world.time();
        }
        z += (forth ? -speed : speed) * world.scene().timestep;
        z = std::min(z, 0.0);
        world.set_collider_pose(0, {.translate = {0, 0, z}}); // where it is to be when the step ends
        world.step();
    }
    const taut::StepReport report = taut::measure(world);
    std::printf(
        "the cloth was pushed %.2f m, the ball turned at %.2f s and is at z = %.2f m; worst stretch %.2f "
        "%%, status %s\n",
        -furthest, turned_at, ball.point.z + z, 100 * report.max_stretch,
        std::string(taut::to_string(report.status)).c_str());
    const bool done =
        !forth && z == 0 && report.penetration < 0.01 && report.status == taut::Status::completed;
    return done ? 0 : 1;
}
