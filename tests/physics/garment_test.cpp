// A real garment on every executor: docs/garment.md states the tolerance.

#include "support/skip.hpp"
#include "support/data.hpp"
#include "support/devices.hpp"

#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace taut;

namespace {

/// Of the diagonal of the garment's box, over 30 frames. Software drivers compute the very bits of the native
/// executor; a hardware GPU divides and takes roots with errors of its own, which cloth amplifies.
constexpr double kHardwareTolerance = 0.01;

std::vector<glm::dvec3> after_thirty_frames(Scene scene, const std::string& device)
{
    World world(scene, test_device(device));
    for (int i = 0; i < 30; ++i)
        world.step();
    return world.positions();
}

} // namespace

TEST_CASE("a skirt of 20,000 triangles falls alike on every executor")
{
    const auto mesh = data_folder() / "meshes/skirt_seamless_20k_cm.obj";
    if (!std::filesystem::exists(mesh))
    {
        TAUT_LEFT_OUT(mesh.string() + " is not there; set TAUT_DATA to the folder of the real meshes");
        return;
    }
    Scene scene = load_scene(std::filesystem::path(TAUT_SOURCE_DIR) / "examples/scenes/skirt.json");
    scene.bodies[0].shape.file = std::filesystem::absolute(mesh);
    scene.method.substeps = 20; // those of the published figures; software drivers are slow
    scene = resolve(scene);
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
        double worst = 0;
        for (std::size_t v = 0; v < got.size(); ++v)
            worst = std::max(worst, glm::length(got[v] - expected[v]));
        INFO(device << ": largest difference " << worst << " m");
        const bool hardware = test_device(device)->info().hardware_gpu;
        CHECK(worst <= (hardware ? kHardwareTolerance * glm::length(high - low) : 0.0));
    }
}
