// A towel over an arm that the program skins. Each frame it blends two bones that meet in an elbow and hands
// over where all vertices of the arm are to be; the towel meets the arm's triangles as it would meet cloth.
#include <taut/taut.hpp>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr double kElbow = 0.05; // half of how far along x the bones share the skin, m

/// The forearm at a time: lifted by 35 degrees within a second, kept there, and lowered again.
glm::dmat4 forearm(double time)
{
    const double lifted = std::clamp(time - 1, 0.0, 1.0) - std::clamp(time - 3, 0.0, 1.0);
    const double smooth = lifted * lifted * (3 - 2 * lifted);
    return glm::rotate(glm::dmat4(1), glm::radians(35 * smooth), glm::dvec3(0, 0, 1)); // about the elbow
}

/// Linear blend skinning: the upper arm, along -x, stands still.
std::vector<glm::dvec3> skinned(const std::vector<glm::dvec3>& rest, double time)
{
    const glm::dmat4 bone = forearm(time);
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& x : rest)
    {
        const double weight = std::clamp(0.5 + x.x / (2 * kElbow), 0.0, 1.0);
        out.push_back((1 - weight) * x + weight * glm::dvec3(bone * glm::dvec4(x, 1)));
    }
    return out;
}

} // namespace

int main()
{
    taut::Body arm;
    arm.shape.kind = taut::ShapeKind::box;
    arm.shape.box_size = {0.8, 0.08, 0.08};
    arm.shape.box_cells = {32, 3, 3};
    arm.material = taut::solid_material();
    arm.kinematic.used = true;
    arm.kinematic.moved_by_program = true;
    arm.contact.friction = 0.6;
    taut::Body towel; // level, above the forearm, across it
    towel.shape.cells = {24, 40};
    towel.shape.size = {0.3, 0.5};
    towel.transform.rotate_axis = {1, 0, 0};
    towel.transform.rotate_degrees = -90;
    towel.transform.translate = {0.2, 0.05, 0};
    towel.material.stretch_stiffness = 2000;
    towel.material.bending_stiffness = 1e-5;
    towel.material.density = 0.3;
    towel.contact.friction = 0.6;
    taut::Scene scene;
    scene.bodies = {arm, towel};
    scene.contact.between = true;
    scene.damping = 0.5;
    taut::World world(scene, taut::Device::open());

    const std::vector<glm::dvec3> rest = world.positions(0);
    const auto run_until = [&](double time) {
        while (world.time() < time)
        {
            world.set_pin_targets(0, 0, skinned(rest, world.time() + world.scene().timestep));
            world.step();
        }
        double height = 0; // m, mean of the towel
        const std::vector<glm::dvec3> x = world.positions(1);
        for (const glm::dvec3& p : x)
            height += p.y / static_cast<double>(x.size());
        return height;
    };
    const double lying = run_until(1), lifted = run_until(3), lowered = run_until(5);
    const taut::StepReport report = taut::measure(world);
    std::printf("the towel lies at %.3f m, is lifted to %.3f m, lies at %.3f m; stretch at the end %.2f %%, "
                "status %s\n",
                lying, lifted, lowered, 100 * report.max_stretch,
                std::string(taut::to_string(report.status)).c_str());
    const bool on_the_arm = lifted > lying + 0.05 && std::abs(lowered - lying) < 0.03;
    return on_the_arm && report.status == taut::Status::completed ? 0 : 1;
}
