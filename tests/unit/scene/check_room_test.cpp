#include "taut/scene/check_room.hpp"

#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"

using namespace taut;
using namespace taut::scene_file;

namespace {

Scene sheets(const std::vector<unsigned>& cells)
{
    Scene scene;
    for (const unsigned n : cells)
    {
        Body& body = scene.bodies.emplace_back();
        body.shape.cells = {n, n};
    }
    return scene;
}

std::string refusal(const Scene& scene, std::uint64_t memory)
{
    try
    {
        check_room(scene, memory);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::out_of_memory);
        return error.what();
    }
    return {};
}

} // namespace

TEST_CASE("bodies that no memory holds are refused before they are made, and the largest is named")
{
    const std::uint64_t gib = std::uint64_t{1} << 30;
    CHECK(refusal(sheets({8000}), 16 * gib).find("fewer cells, of bodies[0]") != std::string::npos);
    CHECK(refusal(sheets({10, 4000, 20}), 4 * gib).find("bodies[1]") != std::string::npos);
    CHECK(refusal(sheets({2000}), 4 * gib).empty());
    CHECK(refusal(sheets({3000, 3000, 3000}), 8 * gib).find("GB") != std::string::npos); // one would fit
    CHECK(refusal(sheets({8000}), 0).empty());
    CHECK(refusal(sheets(std::vector<unsigned>(40, 8000)), 16 * gib).starts_with(
        "the bodies take about 1024 GB, and there are 17 GB here"));
    Scene led = sheets({8000});
    led.bodies[0].kinematic.used = true; // has no constraints
    CHECK(refusal(led, 16 * gib).empty());
    Scene box = sheets({1});
    box.bodies[0].shape.kind = ShapeKind::box;
    box.bodies[0].shape.box_cells = {400, 400, 100};
    CHECK_FALSE(refusal(box, 16 * gib).empty());
    CHECK(host_memory() > gib / 4);
}
