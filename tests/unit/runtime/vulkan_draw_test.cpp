#include "vulkan_support.hpp"

#include "taut/runtime/vulkan/context.hpp"
#include "taut/runtime/vulkan/draw.hpp"

using namespace taut;

TEST_CASE("a renderer leaves nothing behind on the device, whatever it drew and in whatever order things end")
{
    std::shared_ptr<vulkan::ValidationLog> log;
    {
        std::shared_ptr<Device> device = vulkan_test::open_here();
        if (!device || !can_draw(*device))
            return;
        log = vulkan::context_of(*device)->instance->log;
        Surface surface;
        surface.positions = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}};
        surface.triangles = {0, 1, 2};
        surface.lines = {0, 2};
        Renderer first(device);
        device.reset(); // the renderer keeps it
        Shot shot;
        shot.height = 48;
        for (shot.width = 64; shot.width < 67; ++shot.width) // targets of three sizes
            CHECK(first.draw(shot, std::span(&surface, 1)).rgba.size() == 4u * 48 * shot.width);
        surface.triangles[0] = 7;
        CHECK_THROWS_AS(first.draw(shot, std::span(&surface, 1)), Error);
        Renderer second = std::move(first);
        second.draw(shot, {});
    }
    // The layers report what a device still owns when it is destroyed.
    for (const std::string& text : log->texts())
        FAIL_CHECK(text);
    CHECK(log->count() == 0);
}
