#include "taut/kernels/implicit_matrix.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_matrix assembles M + h^2 K + h D into the places of its blocks", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 1000u);
    const bool diagonal_only = GENERATE(false, true);
    const std::uint32_t report = GENERATE(0u, 1u);
    CAPTURE(count, diagonal_only, report);
    Net<Real> net = random_net<Real>(count, 920 + count);
    net.diagonal_only = diagonal_only;
    make_tables(net);
    Case c;
    c.precision = precision_of<Real>();
    c.in = net.buffers();
    const std::vector<Real> before(net.values(), Real(7)); // of an earlier step
    c.in["values"] = bytes_of(before);
    c.launches = {make_launch(kernels::implicit_matrix::info("", c.precision),
                              kernels::implicit_matrix::Params{count, report, net.scale}, count)};
    std::uint32_t degenerate = 0;
    const auto blocks = spring_system(net, degenerate);
    c.events[TAUT_EVENT_DEGENERATE] = report != 0 ? degenerate : 0;
    if (count >= 1000)
        REQUIRE(degenerate > 0);
    Field& values = c.expected["values"];
    values.value.assign(net.values(), 7);
    values.scale.assign(net.values(), 0);
    for (const auto& [place, block] : blocks)
        for (int e = 0; e < 9; ++e)
        {
            const std::size_t at = net.blocks.at(place) + 32u * static_cast<std::size_t>(e);
            values.value[at] = double(net.scale) * block.value[e % 3][e / 3];
            values.scale[at] = double(net.scale) * block.size;
        }
    check_on_every_device(c);
}
