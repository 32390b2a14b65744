#include "taut/kernels/implicit_start.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_start puts what is solved for where the substep began and offers the guess", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 1000u);
    CAPTURE(count);
    const Net<Real> net = random_net<Real>(count, 900 + count);
    Case c;
    c.precision = precision_of<Real>();
    c.in = net.buffers();
    c.in["guess"] = bytes_of(std::vector<Real>(3 * count, Real(7)));
    c.launches = {make_launch(kernels::implicit_start::info("", c.precision),
                              kernels::implicit_start::Params{count, net.lift}, count)};
    Field &delta = c.expected["delta"], &guess = c.expected["guess"];
    for (std::uint32_t v = 0; v < count; ++v)
        for (int k = 0; k < 4; ++k)
        {
            delta.add(double((net.solved(v) ? net.low : net.delta)[v][k]), 0);
            const double far = double(net.predicted[v][k]), near = double(net.low[v][k]);
            if (k < 3)
                guess.add(net.solved(v) ? (far - near) * double(net.lift) : 0,
                          net.solved(v) ? std::abs(far - near) * double(net.lift) : 0);
        }
    check_on_every_device(c);
}
