#include "taut/kernels/damping.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("damping scales every velocity by the factor of the substep and clears w", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const double factor = GENERATE(1.0, 0.97, 0.0);
    const std::uint64_t seed = 100 + count;
    CAPTURE(count, factor, seed);
    Random random(seed);
    const auto velocity = random.vec4s<Real>(count + 7, 20, -1, 1); // seven more that must stay as they are
    layout::StepValues<Real> step{};
    step.damping_factor = static_cast<Real>(factor);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"velocity", bytes_of(velocity)}, {"step_values", bytes_of(std::vector{step})}};
    c.launches = {
        make_launch(kernels::damping::info("", c.precision), kernels::damping::Params{count}, count)};
    Field& expected = c.expected["velocity"];
    for (std::uint32_t i = 0; i < velocity.size(); ++i)
        for (int k = 0; k < 4; ++k)
        {
            const double v = static_cast<double>(velocity[i][k]);
            const double damped = v * static_cast<double>(step.damping_factor);
            if (i >= count)
                expected.add(v, 0);
            else
                expected.add(k < 3 ? damped : 0, k < 3 ? std::abs(damped) : 0);
        }
    check_on_every_device(c);
}
