// The smallest program: a scene in ten lines, a device, sixty steps, a mesh.
#include <taut/taut.hpp>

#include <cstdio>

int main()
{
    taut::Scene scene = taut::parse_scene(R"({
        "taut": 1,
        "bodies": [{"grid": {"cells": [64, 64], "size": [1, 1]},
                    "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}},
                    "material": {"density": 0.2, "stretch_stiffness": 2000}}],
        "colliders": [{"sphere": {"centre": [0, -0.4, 0], "radius": 0.3}, "friction": 0.4}]})");
    taut::World world(scene, taut::Device::open("auto"));
    while (world.time() < 1.0)
        world.step();
    const taut::StepReport report = taut::measure(world);
    std::printf("after %.2f s: worst stretch %.2f %%, status %s\n", report.time, 100 * report.max_stretch,
                taut::to_string(report.status).data());
    taut::Mesh mesh = world.scene().bodies[0].mesh;
    mesh.positions = world.positions();
    taut::write_obj("drape.obj", mesh);
}
