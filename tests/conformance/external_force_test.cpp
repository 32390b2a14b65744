#include "taut/kernels/external_force.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE(
    "a force adds force over mass times the substep to the velocity, and nothing to held vertices", "", float,
    double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint64_t seed = 200 + count;
    CAPTURE(count, seed);
    Random random(seed);
    auto position = random.vec4s<Real>(count + 7, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    position[count / 2].w = 0; // held
    const auto force = random.vec4s<Real>(count + 7, 10, -1, 1);
    const auto velocity = random.vec4s<Real>(count + 7, 5, -1, 1);
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},
            {"force", bytes_of(force)},
            {"velocity", bytes_of(velocity)},
            {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::external_force::info("", c.precision),
                              kernels::external_force::Params{count}, count)};
    Field& expected = c.expected["velocity"];
    for (std::uint32_t i = 0; i < velocity.size(); ++i)
        for (int k = 0; k < 4; ++k)
        {
            const double v = static_cast<double>(velocity[i][k]);
            const double gain = static_cast<double>(force[i][k]) * static_cast<double>(position[i].w) *
                                static_cast<double>(step.substep);
            if (i >= count)
                expected.add(v, 0);
            else if (k == 3)
                expected.add(0, 0);
            else
                expected.add(v + gain, gain == 0 ? 0 : std::abs(v) + std::abs(gain));
        }
    check_on_every_device(c);
}
