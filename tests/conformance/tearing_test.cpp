#include "taut/kernels/tearing.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("springs longer than cloth bears are counted on top of those before", "[tearing]", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint64_t seed = 1500 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const std::uint32_t vertices = count + 3;
    auto position = random.vec4s<Real>(vertices, 1, 0, 2);
    std::vector<layout::DistanceConstraint<Real>> spring;
    for (std::uint32_t i = 0; i < count + 2; ++i) // two behind the end, which must not be counted
        spring.push_back(
            {random.below(vertices), random.below(vertices), random.uniform<Real>(0.3, 2), Real(0)});
    spring[count].rest_length = spring[count + 1].rest_length = Real(-1);
    if (count > 2)
    {
        spring[0].b = spring[0].a; // no length, and bears none: not longer
        spring[0].rest_length = Real(0);
        const std::uint32_t a = spring[1].a, b = (a + 1) % vertices; // exactly as long as it bears
        spring[1] = {a, b, Real(0.5), Real(0)};
        position[b] = position[a];
        position[a].x = Real(1);
        position[b].x = Real(1.5);
    }
    std::uint32_t longer = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        longer += glm::distance(glm::dvec3(position[spring[i].a]), glm::dvec3(position[spring[i].b])) >
                  static_cast<double>(spring[i].rest_length);
    const std::vector<std::uint32_t> before = {7, 99};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Launch launch = make_launch(kernels::tearing::info("", precision_of<Real>()),
                                          kernels::tearing::Params{count}, count);
        const Buffers out = run(*device, {launch},
                                {{"spring", bytes_of(spring)},
                                 {"position", bytes_of(position)},
                                 {"torn", bytes_of(before)}});
        CHECK(values_of<std::uint32_t>(out.at("torn")) == std::vector<std::uint32_t>{7 + longer, 99});
        CHECK(device->counters().validation_messages == 0);
    }
}
