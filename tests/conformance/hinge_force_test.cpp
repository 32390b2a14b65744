#include "taut/kernels/hinge_force.hpp"

#include "support/hinge_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("hinge_force adds at every corner the torque times the gradient of the angle there", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t add = GENERATE(0u, 1u);
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 990 + count;
    CAPTURE(count, add, report, seed);
    Random random(seed);
    const auto net = hinge_net<Real>(random, std::max(count / 3, 2u) + 1);
    REQUIRE(net.position.size() >= count);
    std::vector<std::uint32_t> start, incident;
    net.incidence(count, start, incident);
    const auto force = random.vec4s<Real>(net.position.size(), 100, 0, 0);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},     {"incident", bytes_of(incident)},
            {"hinge", bytes_of(net.hinge)}, {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},     {"force", bytes_of(force)},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::hinge_force::info("", c.precision),
                              kernels::hinge_force::Params{count, add, report}, count)};
    std::vector<glm::dvec3> sum(net.position.size(), glm::dvec3(0));
    std::vector<double> scale(net.position.size(), 0.0);
    for (std::uint32_t k = 0; k < net.hinge.size(); ++k)
        for (std::uint32_t corner = 0; corner < 4; ++corner)
        {
            const std::uint32_t v = net.corners(k)[corner];
            if (v >= count)
                continue;
            double size = 0;
            const HingeTerm term = hinge_term(net.hinge[k], net.places(k, size), size, corner);
            const double stiff = 1 / double(net.hinge[k].compliance);
            sum[v] -= term.gradient * (term.value * stiff);
            scale[v] += stiff * (term.gradient_scale * std::abs(term.value) +
                                 glm::length(term.gradient) * term.value_scale);
            c.events[TAUT_EVENT_DEGENERATE] += report != 0 && corner == 0 && !term.shaped ? 1 : 0;
        }
    Field& field = c.expected["force"];
    for (std::uint32_t v = 0; v < force.size(); ++v)
        for (int k = 0; k < 4; ++k)
        {
            const double before = v >= count || (add != 0 && k < 3) ? double(force[v][k]) : 0;
            const bool added = v < count && k < 3;
            field.add(before + (added ? sum[v][k] : 0), added ? scale[v] + std::abs(before) : 0);
        }
    check_on_every_device(c);
}
