#include "taut/kernels/dot.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("dot leaves one partial sum a group", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::uint32_t groups = GENERATE(1u, 3u);
    const std::uint32_t chunk = (count + groups - 1) / groups;
    Random random(300 + count + groups);
    std::vector<Real> x, y;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        x.push_back(static_cast<Real>(random.uniform(-1, 1)));
        y.push_back(static_cast<Real>(random.uniform(-1, 1)));
    }
    CAPTURE(count, groups);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {
        {"x", bytes_of(x)}, {"y", bytes_of(y)}, {"partials", bytes_of(std::vector<Real>(groups, Real(7)))}};
    // One group more than there is: what folding may bring.
    c.launches = {make_launch(kernels::dot::info("", c.precision), kernels::dot::Params{count, chunk, groups},
                              groups + 1)};
    Field& expected = c.expected["partials"];
    for (std::uint32_t group = 0; group < groups; ++group)
    {
        double sum = 0, size = 0;
        for (std::uint32_t i = group * chunk; i < std::min(count, (group + 1) * chunk); ++i)
        {
            sum += static_cast<double>(x[i]) * static_cast<double>(y[i]);
            size += std::abs(static_cast<double>(x[i]) * static_cast<double>(y[i]));
        }
        expected.add(sum, size);
    }
    check_on_every_device(c);
}
