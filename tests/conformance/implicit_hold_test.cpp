#include "taut/kernels/implicit_hold.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_hold keeps light vertices that a collider moved, for the rest of the substep",
                   "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint32_t first = GENERATE(1u, 0u);
    CAPTURE(count, first);
    Random random(2900 + count);
    const std::uint32_t all = count + 7;
    const auto before = random.vec4s<Real>(all, 1, -1, 1);
    auto delta = before;
    std::vector<std::uint32_t> held, light, marks, want;
    for (std::uint32_t v = 0; v < all; ++v)
    {
        const std::uint32_t kind = random.below(5);
        if (kind > 0 && kind < 4) // along one axis alone, and by the last bit
            delta[v][int(kind) - 1] = std::nextafter(delta[v][int(kind) - 1], Real(2));
        delta[v].w += Real(1); // says nothing
        const bool never = random.chance(0.2), marked = never || random.chance(0.3);
        light.push_back(random.chance(0.5) ? 1u : 0u);
        const bool pushed = light.back() != 0 && kind > 0 && kind < 4;
        const bool stays = never || (first == 0 && (marked || pushed));
        held.insert(held.end(), 3, never ? 1u : 0u);
        marks.insert(marks.end(), 3, marked ? 1u : 0u);
        want.insert(want.end(), 3, v < count ? (stays ? 1u : 0u) : marks.back());
    }
    const std::vector<Launch> launches = {
        make_launch(kernels::implicit_hold::info("", precision_of<Real>()),
                    kernels::implicit_hold::Params{count, first}, count)};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, launches,
                                {{"held", bytes_of(held)},
                                 {"light", bytes_of(light)},
                                 {"before", bytes_of(before)},
                                 {"delta", bytes_of(delta)},
                                 {"marks", bytes_of(marks)}});
        CHECK(values_of<std::uint32_t>(out.at("marks")) == want);
        CHECK(device->counters().validation_messages == 0);
    }
}
