#include "taut/kernels/constraint_total.hpp"

#include "support/linear_groups.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("constraint_total sums the solves of a substep and starts the next", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 129u, 1000u);
    const std::uint32_t first = GENERATE(0u, 1u);
    const bool nothing = GENERATE(false, true);
    CAPTURE(count, first, nothing);
    Random random(80 + count);
    const std::vector<Real> x = random_reals<Real>(random, count + 4);
    const std::vector<Real> multiplier = random_reals<Real>(random, count + 4);
    layout::CgState<Real> state{};
    state.status = nothing ? TAUT_CG_ZERO_RIGHT_HAND_SIDE : TAUT_CG_STALLED;

    Case c;
    c.precision = precision_of<Real>();
    c.in = {
        {"x", bytes_of(x)}, {"multiplier", bytes_of(multiplier)}, {"state", bytes_of(std::vector{state})}};
    c.launches = {make_launch(kernels::constraint_total::info("", c.precision),
                              kernels::constraint_total::Params{count, first}, count)};
    for (std::uint32_t i = 0; i < count + 4; ++i)
    {
        const double found = static_cast<double>(x[i]), before = static_cast<double>(multiplier[i]);
        const double total = before + (nothing ? 0 : found), size = std::abs(before) + std::abs(found);
        const bool inside = i < count;
        c.expected["x"].add(!inside ? found : first ? total : 0, inside && first ? size : 0);
        c.expected["multiplier"].add(!inside ? before : first ? 0 : total, inside && !first ? size : 0);
    }
    check_on_every_device(c);
}
