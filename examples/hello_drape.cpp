// The smallest program: a scene of plain values, a device, sixty steps, a mesh.
#include <taut/taut.hpp>

#include <cstdio>
#include <string>

int main()
{
    taut::Body cloth;
    cloth.shape = taut::shapes::Grid{.cells = {64, 64}, .size = {1, 1}}; // m, in the plane z = 0
    cloth.transform.rotate_axis = {1, 0, 0};
    cloth.transform.rotate_degrees = -90;
    cloth.material.density = 0.2;            // kg/m^2
    cloth.material.stretch_stiffness = 2000; // N/m
    taut::Scene scene;
    scene.bodies = {cloth};
    scene.colliders = {taut::colliders::Sphere{.centre = {0, -0.4, 0}, .radius = 0.3, .friction = 0.4}};
    scene.method = taut::methods::Xpbd{.substeps = 160}; // fewer are cheaper, and stretch more
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
