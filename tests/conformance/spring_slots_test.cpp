#include "taut/kernels/spring_slots.hpp"

#include "support/spring_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("spring_slots writes each spring's force on its first end", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool damped = GENERATE(false, true);
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 930 + count;
    CAPTURE(count, damped, report, seed);
    Random random(seed);
    const auto net = spring_net<Real>(random, count + 9, count + 5, damped);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"spring", bytes_of(net.spring)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"velocity", bytes_of(net.velocity)},
            {"slot", bytes_of(std::vector<glm::vec<4, Real>>(net.spring.size(), glm::vec<4, Real>(7)))},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::spring_slots::info(damped ? "damped" : "", c.precision),
                              kernels::spring_slots::Params{count, report}, count)};
    Field& slot = c.expected["slot"];
    for (std::uint32_t k = 0; k < net.spring.size(); ++k)
    {
        double scale = 0;
        const glm::dvec3 f = net.force(k, scale);
        for (int i = 0; i < 4; ++i)
            slot.add(k < count ? (i < 3 ? f[i] : 0) : 7, k < count && i < 3 ? scale : 0);
        c.events[TAUT_EVENT_DEGENERATE] += report != 0 && k < count && net.degenerate(k) ? 1 : 0;
    }
    check_on_every_device(c);
}
