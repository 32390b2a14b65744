// The smallest program: a scene of plain values, a device, sixty steps, a mesh.
#include <taut/taut.hpp>

#include <cstdio>
#include <string>

int main()
{
    taut::Body cloth; // 1 m by 1 m in the plane z = 0
    cloth.shape.cells = {64, 64};
    cloth.transform.rotate_axis = {1, 0, 0};
    cloth.transform.rotate_degrees = -90;
    cloth.material.density = 0.2;            // kg/m^2
    cloth.material.stretch_stiffness = 2000; // N/m
    taut::Collider ball;
    ball.point = {0, -0.4, 0};
    ball.radius = 0.3;
    ball.friction = 0.4;
    taut::Scene scene;
    scene.bodies = {cloth};
    scene.colliders = {ball};
    taut::World world(scene, taut::Device::open("auto"));
    while (world.time() < 1.0)
        world.step();
    const taut::StepReport report = taut::measure(world);
    std::printf("after %.2f s: worst stretch %.2f %%, status %s\n", report.time, 100 * report.max_stretch,
                std::string(taut::to_string(report.status)).c_str());
    taut::Mesh mesh = world.scene().bodies[0].mesh;
    mesh.positions = world.positions();
    taut::write_obj("drape.obj", mesh);
}
