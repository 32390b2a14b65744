// Garments on every executor: docs/garment.md states the tolerance.

#include "support/data.hpp"
#include "support/devices.hpp"

#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <filesystem>

using namespace taut;

namespace {

/// Of the diagonal of the garment's box, over 30 frames. Software drivers compute the very bits of the native
/// executor; a hardware GPU divides and takes roots with errors of its own, which cloth amplifies.
constexpr double kHardwareTolerance = 0.01;

std::vector<glm::dvec3> after_thirty_frames(const Scene& scene, const std::string& device)
{
    World world(scene, test_device(device));
    for (int i = 0; i < 30; ++i)
        world.step();
    return world.positions();
}

void check_every_executor(const Scene& scene)
{
    glm::dvec3 low(1e9), high(-1e9);
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
    {
        low = glm::min(low, x);
        high = glm::max(high, x);
    }
    const std::vector<glm::dvec3> expected = after_thirty_frames(scene, "cpu:serial");
    for (const std::string& device : test_devices())
    {
        const std::vector<glm::dvec3> got = after_thirty_frames(scene, device);
        REQUIRE(got.size() == expected.size());
        double worst = 0;
        for (std::size_t v = 0; v < got.size(); ++v)
            worst = std::max(worst, glm::length(got[v] - expected[v]));
        INFO(device << ": largest difference " << worst << " m");
        const bool hardware = test_device(device)->info().hardware_gpu;
        CHECK(worst <= (hardware ? kHardwareTolerance * glm::length(high - low) : 0.0));
    }
}

} // namespace

TEST_CASE("a skirt falls alike on every executor")
{
    check_every_executor(
        resolve(load_scene(std::filesystem::path(TAUT_SOURCE_DIR) / "examples/scenes/skirt.json")));
}

TEST_CASE("a skirt of 20,000 triangles, with edges of many lengths, falls alike on every executor")
{
    const auto mesh = find_data("meshes/skirt_seamless_20k_cm.obj");
    if (!mesh)
        return;
    Scene scene;
    scene.timestep = 1.0 / 60;
    scene.damping = 0.5;
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 20;
    Body& skirt = scene.bodies.emplace_back();
    skirt.shape.kind = ShapeKind::mesh;
    skirt.shape.file = std::filesystem::absolute(*mesh);
    skirt.material.density = 0.2;
    skirt.material.stretch_stiffness = 2000;
    skirt.material.bending_stiffness = 1e-5;
    skirt.material.thickness = 0.002;
    skirt.transform = {.rotate_axis = {0, 0, 1}, .rotate_degrees = 180, .scale = 0.01};
    Pin& waist = skirt.pins.emplace_back();
    waist.use_box = true;
    waist.box_min = {-1, 0.44, -1};
    waist.box_max = {1, 1, 1};
    Collider& ball = scene.colliders.emplace_back();
    ball.kind = ColliderKind::sphere;
    ball.point = {0, 0.12, -0.01};
    ball.radius = 0.17;
    ball.friction = 0.3;
    check_every_executor(resolve(scene));
}
