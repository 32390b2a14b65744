#include "taut/kernels/slot_sum.hpp"

#include "support/spring_net.hpp"

#include "taut/kernels/spring_force.hpp"
#include "taut/kernels/spring_slots.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("slot_sum adds the slots of a vertex with the sign of its end", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(950 + count);
    const auto net = spring_net<Real>(random, count + 9, 3 * count + 2, false);
    const auto slot = random.vec4s<Real>(net.spring.size(), 100, -1, 1); // w means nothing
    std::vector<std::uint32_t> start, incident;
    net.incidence(count, start, incident);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},
            {"incident", bytes_of(incident)},
            {"slot", bytes_of(slot)},
            {"force", bytes_of(std::vector<glm::vec<4, Real>>(net.position.size(), glm::vec<4, Real>(7)))}};
    c.launches = {
        make_launch(kernels::slot_sum::info("", c.precision), kernels::slot_sum::Params{count}, count)};
    Field& force = c.expected["force"];
    for (std::uint32_t v = 0; v < net.position.size(); ++v)
    {
        glm::dvec3 sum(0), size(0);
        for (std::uint32_t k = v < count ? start[v] : 0; v < count && k < start[v + 1]; ++k)
        {
            const glm::dvec3 f(slot[incident[k] / 2]);
            sum += incident[k] % 2 == 0 ? f : -f;
            size += glm::abs(f);
        }
        for (int i = 0; i < 4; ++i)
            force.add(v < count ? (i < 3 ? sum[i] : 0) : 7, v < count && i < 3 ? size[i] : 0);
    }
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("gathering springs and summing their slots give the same forces, bit for bit", "", float,
                   double)
{
    using Real = TestType;
    const bool damped = GENERATE(false, true);
    CAPTURE(damped);
    Random random(970);
    constexpr std::uint32_t count = 700;
    const auto net = spring_net<Real>(random, count, 6 * count, damped);
    const auto springs = static_cast<std::uint32_t>(net.spring.size());
    std::vector<std::uint32_t> start, incident;
    net.incidence(count, start, incident);
    const std::vector<glm::vec<4, Real>> none(springs, glm::vec<4, Real>(7));
    const Buffers in = {{"start", bytes_of(start)},
                        {"incident", bytes_of(incident)},
                        {"end", bytes_of(net.ends(incident))},
                        {"spring", bytes_of(net.spring)},
                        {"position", bytes_of(net.position)},
                        {"low", bytes_of(net.low)},
                        {"velocity", bytes_of(net.velocity)},
                        {"slot", bytes_of(none)},
                        {"force", bytes_of(std::vector(count, glm::vec<4, Real>(7)))},
                        {"events", no_events()}};
    const Precision precision = precision_of<Real>();
    const char* variant = damped ? "damped" : "";
    const std::vector<Launch> gather = {make_launch(kernels::spring_force::info(variant, precision),
                                                    kernels::spring_force::Params{count, 1}, count)};
    const std::vector<Launch> slots = {
        make_launch(kernels::spring_slots::info(variant, precision),
                    kernels::spring_slots::Params{springs, 1}, springs),
        make_launch(kernels::slot_sum::info("", precision), kernels::slot_sum::Params{count}, count)};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision) || !bitwise_equal_expected(device->info()))
            continue;
        CAPTURE(selector);
        const Buffers one = run(*device, gather, in), two = run(*device, slots, in);
        CHECK(one.at("force") == two.at("force"));
        CHECK(one.at("events") == two.at("events"));
    }
}
