#include "taut/kernels/plate_turn.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

#include "taut/kernels/shared/plate_rule.h"

#include <cmath>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kRule = TAUT_PLATE_RULE;

/// Every other record belongs to no plate. One hinge is so soft that its compliance over h^2 is cut off.
template <typename Real>
void check_turns(std::uint32_t count)
{
    Random random(4100 + count);
    std::vector<std::uint32_t> record;
    std::vector<layout::BendingConstraint<Real>> hinge;
    std::vector<Real> multiplier, rule, pull;
    for (std::uint32_t k = 0; k < 2 * count; ++k)
    {
        hinge.push_back({k, k + 1, k + 2, k + 3, random.uniform<Real>(-3, 3), random.uniform<Real>(0, 10)});
        multiplier.push_back(random.uniform<Real>(-1e-4, 1e-4));
    }
    for (const std::uint32_t k : random.shuffled(count))
        record.push_back(2 * k);
    hinge[record[0]].compliance = Real(1e30);
    multiplier[record[0]] = Real(1e-31);
    for (std::uint32_t k = 0; k < kRule * count; ++k)
        rule.push_back(random.uniform<Real>(0, 1));
    for (std::uint32_t k = 0; k < 2 * count; ++k)
        pull.push_back(random.uniform<Real>(-1, 1));
    layout::StepValues<Real> step{};
    step.inverse_substep = Real(200);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"record", bytes_of(record)},
            {"hinge", bytes_of(hinge)},
            {"multiplier", bytes_of(multiplier)},
            {"step_values", bytes_of(std::vector{step})},
            {"rule", bytes_of(rule)},
            {"pull", bytes_of(pull)},
            {"turn", bytes_of(std::vector<Real>(2 * count, Real(7)))}};
    c.launches = {
        make_launch(kernels::plate_turn::info("", c.precision), kernels::plate_turn::Params{count}, count)};
    Field& turn = c.expected["turn"];
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const double soft = std::min(double(hinge[record[i]].compliance) * 200 * 200, 1e30);
        const double bent = -soft * double(multiplier[record[i]]), share = rule[kRule * i + 1];
        for (std::uint32_t side = 0; side < 2; ++side)
        {
            const double own = pull[2 * i + side];
            turn.add(own + (side == 0 ? share : 1 - share) * bent, std::abs(own) + std::abs(bent));
        }
    }
    check_on_every_device(c);
}

} // namespace

TEMPLATE_TEST_CASE("plate_turn shares the moment of a hinge out to both of its triangles", "[plate]", float,
                   double)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    check_turns<TestType>(count);
}
