#include "taut/kernels/implicit_euler_hinge.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_euler_hinge adds forces and Gauss-Newton blocks of hinges", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(4u, 63u, 64u, 65u, 127u, 128u, 1000u);
    const bool diagonal_only = GENERATE(false, true);
    const std::uint32_t report = GENERATE(0u, 1u);
    CAPTURE(count, diagonal_only, report);
    Net<Real> net = random_net<Real>(count, 930 + count);
    net.diagonal_only = diagonal_only;
    make_tables(net);
    Random random(931 + count);
    const auto side = random_reals<Real>(random, 3 * count);
    const auto before = random_reals<Real>(random, net.values());
    Case c;
    c.precision = precision_of<Real>();
    c.in = net.buffers();
    c.in["table"] = bytes_of(net.hinge_table);
    c.in["b"] = bytes_of(side);
    c.in["values"] = bytes_of(before);
    const kernels::implicit_euler_hinge::Params params{count, report, net.scale, net.lift};
    c.launches = {make_launch(kernels::implicit_euler_hinge::info("", c.precision), params, count)};
    std::uint32_t degenerate = 0, unused = 0;
    const auto blocks = hinge_system(net, degenerate);
    const auto springs = spring_system(net, unused);
    c.events[TAUT_EVENT_DEGENERATE] = report != 0 ? degenerate : 0;

    std::vector<Sized> pull(count);
    for (const auto& hinge : net.hinges)
    {
        const HingeTerms t = hinge_terms(net, hinge);
        const auto v = corners_of(hinge);
        const double turn = std::remainder(t.angle - double(hinge.rest_angle), 2 * 3.14159265358979323846);
        const double factor = net.h() * net.h() / double(hinge.compliance);
        for (std::size_t k = 0; k < 4 && t.shaped; ++k)
            if (net.solved(v[k]))
                pull[v[k]].add(-factor * turn * t.gradient[k], factor * 4 * t.shape * t.steep);
    }
    Field& b = c.expected["b"];
    const double units = double(net.scale) * double(net.lift);
    for (std::uint32_t v = 0; v < count; ++v)
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const double old = double(side[3 * v + k]);
            const double more = units * pull[v].value[static_cast<int>(k)];
            b.add(old + more, pull[v].size > 0 ? std::abs(old) + units * pull[v].size : 0);
        }
    Field& values = c.expected["values"];
    for (const Real value : before)
        values.add(double(value), 0);
    for (const auto& [place, block] : blocks)
        for (int e = 0; e < 9; ++e)
        {
            const std::size_t at = net.blocks.at(place) + 32u * static_cast<std::size_t>(e);
            const double old = springs.count(place) > 0 ? double(before[at]) : 0; // else its first holder
            values.value[at] = old + double(net.scale) * block.value[e % 3][e / 3];
            values.scale[at] = std::abs(old) + double(net.scale) * block.size;
        }
    check_on_every_device(c);
}
