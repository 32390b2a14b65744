// What the contracts of World and Device allow several threads: a world each, also on one device. Under
// -fsanitize=thread this is their proof (TAUT_TEST_DEVICES=cpu,cpu:serial: drivers are not instrumented).

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/program_moves.hpp"

#include "taut/world/world.hpp"

#include <thread>

using namespace taut;

namespace {

/// Makes a world, moves it by the program and reads it on the way. Body 0 may be put elsewhere.
WorldState life(const std::shared_ptr<Device>& device, std::size_t steps, bool jumps)
{
    World world(test::moved_scene(false), device);
    for (std::size_t k = 1; k <= steps; ++k)
    {
        test::order(world, k);
        if (jumps && k == steps / 2)
        {
            world.set_positions(0, world.positions(0));
            world.set_velocities(0, std::vector(world.body_range(0).count, glm::dvec3(0, 1, 0)));
        }
        world.step();
        if (k % 4 == 0)
            static_cast<void>(world.velocities());
    }
    return world.state();
}

} // namespace

TEST_CASE("two worlds in two threads, on one device or two, move as one after the other")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const std::shared_ptr<Device> one = test_device(selector);
    const bool shared = GENERATE(true, false);
    const std::shared_ptr<Device> two = shared ? one : test_device("cpu:serial");
    constexpr std::size_t kSteps = 12;
    const WorldState first = life(one, kSteps, false), second = life(two, kSteps, true);
    WorldState a, b;
    std::thread other([&] { b = life(two, kSteps, true); });
    a = life(one, kSteps, false);
    other.join();
    CHECK((a.position == first.position));
    CHECK((a.velocity == first.velocity));
    CHECK((b.position == second.position));
    CHECK((b.velocity == second.velocity));
    CHECK((a.position != b.position));
}

TEST_CASE("a world may go from one thread to another")
{
    World world(test::moved_scene(false), test_device("cpu")),
        other(test::moved_scene(false), test_device("cpu"));
    for (std::size_t k = 1; k <= 6; ++k)
    {
        test::order(world, k);
        world.step();
        std::thread([&] {
            test::order(other, k);
            other.step();
        }).join();
    }
    CHECK((world.state().position == other.state().position));
}
