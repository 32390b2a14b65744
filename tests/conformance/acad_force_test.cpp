#include "taut/kernels/acad_force.hpp"

#include "conformance/tolerances.hpp"
#include "support/acad_net.hpp"
#include "support/spring_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("acad_force leaves out the springs that are constraints, and counts them", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(2u, 63u, 64u, 65u, 1000u);
    const bool damped = GENERATE(false, true), compress = GENERATE(false, true);
    const std::uint32_t awake = GENERATE(0u, 1u);
    CAPTURE(count, damped, compress, awake);
    Random random(150 + count);
    auto net = spring_net<Real>(random, count, 3 * count, damped); // every vertex runs
    const auto springs = static_cast<std::uint32_t>(net.spring.size());
    std::vector<std::uint32_t> flags = random_flags(random, springs, 0.4, compress), start, incident;
    flags.push_back(awake);
    std::vector<bool> row(springs);
    Case c;
    for (std::uint32_t k = 0; k < springs; ++k)
    {
        auto& s = net.spring[k];
        const double length = glm::length(glm::dvec3(net.position[s.a]) - glm::dvec3(net.position[s.b]));
        if (length > 0.01 && s.rest_length > 0)
            s.rest_length = static_cast<Real>(length / (1 + random.uniform(compress ? -0.1 : -0.02, 0.1)));
        const double stretch = length / static_cast<double>(s.rest_length) - 1;
        const std::uint32_t before = awake != 0 ? flags[k] : TAUT_ACAD_SPRING;
        const bool far = stretch > 0.05 || (compress && stretch < -0.05);
        row[k] = before % 2 == 1 || (k % 5 != 0 && s.rest_length > 0 && far);
    }
    net.incidence(count, start, incident);
    auto ends = net.ends(incident);
    std::uint32_t counted = 0;
    for (std::size_t e = 0; e < ends.size(); ++e)
        ends[e].kind = incident[e] / 2 * 2 + (incident[e] / 2 % 5 != 0 ? 1 : 0);
    for (std::uint32_t k = 0; k < springs; ++k)
        counted +=
            net.spring[k].a != net.spring[k].b && (row[k] || (awake != 0 && flags[k] != TAUT_ACAD_SPRING));
    std::vector<std::uint32_t> events(TAUT_EVENT_WORDS, 0);
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)}, {"end", bytes_of(ends)}, {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)}, {"velocity", bytes_of(net.velocity)}, {"flags", bytes_of(flags)},
            {"force", bytes_of(std::vector<glm::vec<4, Real>>(net.position.size(), glm::vec<4, Real>(7)))},
            {"events", bytes_of(events)}};
    c.launches = {make_launch(kernels::acad_force::info(damped ? "damped" : "", c.precision),
                              kernels::acad_force::Params{count, 0, springs, 0.05f,
                                                          static_cast<float>(0.05 - double(0.05f)), -1.f, 0.f,
                                                          compress},
                              count)};
    for (std::uint32_t k = 0; k < springs; ++k)
        if (row[k]) // no force: neither spring nor damper
            net.spring[k].stiffness = net.spring[k].damping = 0;
    Field& expected = c.expected["force"];
    net.expect_forces(count, expected);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, c.precision))
            continue;
        INFO(selector);
        const Buffers out = run(*device, c.launches, c.in);
        const auto actual = reals_of<Real>(out.at("force"));
        const double eps = sizeof(Real) == 8 ? 0x1p-52 : 0x1p-23;
        CHECK(first_difference(expected, actual, tolerance_of("acad_force") * eps) == "");
        CHECK(values_of<std::uint32_t>(out.at("events"))[TAUT_EVENT_ACAD] == counted);
        if (bitwise_equal_expected(device->info()))
            CHECK(differing_buffers(run(*test_device("cpu:serial"), c.launches, c.in), out) == "");
        CHECK(device->counters().validation_messages == 0);
    }
}
