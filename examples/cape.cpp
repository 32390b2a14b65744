// A cape on shoulders that walk, turn and stop: its pins are attached to a moving frame, which a game would
// take from its skeleton. The body below is a capsule that follows the same frame.
#include <taut/taut.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace {

/// Where the character is at a time: along a circle of 1 m, looking ahead, for four seconds.
taut::Keyframe frame_at(double time)
{
    const double angle = 0.8 * std::min(time, 4.0) * std::min(time, 4.0) / 4.0; // faster and faster, rad
    return {.translate = {1 - std::cos(angle), 0, -std::sin(angle)},
            .rotate_axis = {0, 1, 0},
            .rotate_degrees = -angle * 180 / 3.14159265358979};
}

} // namespace

int main()
{
    taut::Body cape; // behind the back, which is the plane z = 0.16
    cape.shape.cells = {24, 32};
    cape.shape.size = {0.6, 1.0};
    cape.transform.translate = {0, 0, 0.16};
    cape.material.stretch_stiffness = 2000;
    cape.material.bending_stiffness = 1e-5;
    cape.material.drag = 0.5;
    cape.pins.resize(1);
    cape.pins[0].edges = {"top"};
    cape.pins[0].moved_by_program = true;
    taut::Collider back; // from the knees to the neck
    back.kind = taut::ColliderKind::capsule;
    back.point = {0, -0.6, 0};
    back.end = {0, 0.4, 0};
    back.radius = 0.13;
    back.friction = 0.2;
    taut::Scene scene;
    scene.bodies = {cape};
    scene.colliders = {back};
    scene.wind.density = 1.2; // still air, which the cape catches
    taut::World world(scene, taut::Device::open());

    double lowest = 0, behind = 0;
    while (world.time() < 6)
    {
        const taut::Keyframe frame = frame_at(world.time() + world.scene().timestep);
        world.set_pin_pose(0, 0, frame); // one pose for the pins and for the body: they move as one
        world.set_collider_pose(0, frame);
        if (world.time() < 4)
            world.set_wind({0, 0, 2 * std::sin(5 * world.time())});
        world.step();
        // How high the hem flies, m over where it hangs.
        const std::vector<glm::dvec3> x = world.positions(0);
        lowest = std::min_element(x.begin(), x.end(), [](auto& a, auto& b) { return a.y < b.y; })->y;
        behind = std::max(behind, lowest + 0.5);
    }
    const taut::StepReport report = taut::measure(world);
    std::printf(
        "the hem flew %.2f m high and hangs at %.2f m; penetration %.4f, worst stretch %.2f %%, status %s\n",
        behind, lowest, report.penetration, 100 * report.max_stretch,
        std::string(taut::to_string(report.status)).c_str());
    const bool done = behind > 0.05 && lowest < -0.45 && report.status == taut::Status::completed;
    return done ? 0 : 1;
}
