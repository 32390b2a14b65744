// An engine's own device: World runs on it and records its steps into the engine's commands.

#include "unit/runtime/vulkan_host.hpp"

#include "support/program_moves.hpp"
#include "support/scenes.hpp"

#include "taut/world/world.hpp"

using namespace taut;

TEST_CASE("steps recorded into an engine's commands move the world as its own do, moving pins and all")
{
    const auto host = vulkan_test::Host::open();
    if (!host)
        return;
    {
        const std::shared_ptr<Device> device = adopt(host->context());
        World own(test::everything(), device), recorded(test::everything(), device);
        for (int i = 0; i < 3; ++i)
        {
            own.step();
            host->begin();
            recorded.record_into(host->commands);
            host->submit_and_wait();
        }
        const WorldState a = own.state(), b = recorded.state();
        CHECK(a.step == b.step);
        CHECK(a.position == b.position);
        CHECK(a.velocity == b.velocity);
        CHECK(own.positions()[0].y > World(test::everything(), device).positions()[0].y);
    }
    CHECK(host->messages.empty());
}

TEST_CASE("steps that wait or run together move the world as steps one by one do")
{
    const auto host = vulkan_test::Host::open();
    if (!host)
        return;
    const std::size_t in_flight = GENERATE(1u, 2u, 3u, 4u);
    {
        const std::shared_ptr<Device> device = adopt(host->context());
        World own(test::everything(), device), recorded(test::everything(), device);
        vulkan_test::Flights flights(*host, in_flight);
        const std::size_t vertices = own.positions().size();
        for (int i = 0; i < 12; ++i)
        {
            if (i == 6) // between frames that may still run
            {
                own.set_gravity({3, -5, 0});
                recorded.set_gravity({3, -5, 0});
            }
            const std::vector<glm::dvec3> forces(vertices, {0.02 * i, 0, -0.01 * i});
            own.set_forces(forces); // others in each frame, while those before may still run
            recorded.set_forces(forces);
            own.step();
            recorded.record_into(flights.begin());
            flights.submit();
        }
        flights.wait();
        CHECK(own.state().position == recorded.state().position);
        CHECK(own.state().velocity == recorded.state().velocity);
    }
    CHECK(host->messages.empty());
}

constexpr std::size_t kPlacedAt = 9;

TEST_CASE("what the program moves is as by keyframes with several frames in flight")
{
    const auto host = vulkan_test::Host::open();
    if (!host)
        return;
    const std::size_t in_flight = GENERATE(1u, 2u, 3u, 4u);
    {
        const std::shared_ptr<Device> device = adopt(host->context());
        World by_keys(test::moved_scene(true), device), recorded(test::moved_scene(false), device);
        vulkan_test::Flights flights(*host, in_flight);
        for (std::size_t k = 1; k <= test::kMovedSteps; ++k)
        {
            if (k != kPlacedAt)
                by_keys.step();
            test::order(recorded, k);
            if (k == kPlacedAt) // between frames that may still run
            {
                const auto& rest = recorded.scene().bodies[0].mesh.positions;
                by_keys.set_positions(0, rest);
                recorded.set_positions(0, rest);
            }
            recorded.record_into(flights.begin());
            flights.submit();
            if (k == kPlacedAt)
                by_keys.step();
        }
        flights.wait();
        CHECK((by_keys.state().position == recorded.state().position));
        CHECK((by_keys.state().velocity == recorded.state().velocity));
    }
    CHECK(host->messages.empty());
}

TEST_CASE("a world of another executor cannot record into Vulkan commands")
{
    World world(test::hanging(), Device::open("cpu:serial"));
    CHECK_THROWS_AS(world.record_into(nullptr), Error);
}
