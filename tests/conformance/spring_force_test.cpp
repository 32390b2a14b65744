#include "taut/kernels/spring_force.hpp"

#include "support/spring_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("spring_force adds at every vertex the forces of the springs that end there", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool damped = GENERATE(false, true);
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 910 + count;
    CAPTURE(count, damped, report, seed);
    Random random(seed);
    const auto net = spring_net<Real>(random, count + 9, 3 * count + 2, damped);
    std::vector<std::uint32_t> start, incident;
    net.incidence(count, start, incident);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},
            {"end", bytes_of(net.ends(incident))},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"velocity", bytes_of(net.velocity)},
            {"force", bytes_of(std::vector<glm::vec<4, Real>>(net.position.size(), glm::vec<4, Real>(7)))},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::spring_force::info(damped ? "damped" : "", c.precision),
                              kernels::spring_force::Params{count, report}, count)};
    net.expect_forces(count, c.expected["force"]);
    // Counted by the lower end, where that vertex is among those that run.
    for (std::uint32_t k = 0; k < net.spring.size(); ++k)
        if (report != 0 && net.degenerate(k) && std::min(net.spring[k].a, net.spring[k].b) < count)
            ++c.events[TAUT_EVENT_DEGENERATE];
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("a vertex of 10,000 springs is one invocation like others", "", float, double)
{
    using Real = TestType;
    Random random(77);
    SpringNet<Real> net = spring_net<Real>(random, 300, 10000, false);
    for (auto& s : net.spring)
    {
        s.a = 0;
        s.b = 1 + s.b % 299;
    }
    std::vector<std::uint32_t> start, incident;
    net.incidence(1, start, incident);
    REQUIRE(incident.size() == 10000);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},
            {"end", bytes_of(net.ends(incident))},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"force", bytes_of(std::vector<glm::vec<4, Real>>(net.position.size(), glm::vec<4, Real>(7)))},
            {"events", no_events()}};
    c.launches = {
        make_launch(kernels::spring_force::info("", c.precision), kernels::spring_force::Params{1, 0}, 1)};
    net.expect_forces(1, c.expected["force"]);
    check_on_every_device(c);
}
