#include "taut/kernels/coast.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("coast says where gravity alone takes what moves, at any speed", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint64_t seed = 1400 + count;
    CAPTURE(count, seed);
    Random random(seed);
    auto position = random.vec4s<Real>(count + 7, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    const auto low = random.vec4s<Real>(count + 7, 1e-8, 0, 1e-2);
    auto velocity = random.vec4s<Real>(count + 7, 3, -1, 1);
    const auto before = random.vec4s<Real>(count + 7, 1, 0, 1);
    if (count > 2)
    {
        position[1].w = Real(0); // held, whatever its speed
        velocity[1] = {Real(300), Real(-400), Real(0), Real(5)};
        velocity[2] = {Real(1e6), Real(0), Real(-1e6), Real(5)}; // no limit here
    }
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    step.gravity_x = Real(0.5);
    step.gravity_y = Real(-9.81);
    step.gravity_z = Real(0.25);
    step.max_speed = Real(10);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},
            {"low", bytes_of(low)},
            {"velocity", bytes_of(velocity)},
            {"coasting", bytes_of(before)},
            {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::coast::info("", c.precision), kernels::coast::Params{count}, count)};
    Field& expected = c.expected["coasting"];
    const double h = double(step.substep);
    const double gravity[] = {double(step.gravity_x), double(step.gravity_y), double(step.gravity_z)};
    for (std::uint32_t i = 0; i < before.size(); ++i)
        for (int k = 0; k < 4; ++k)
        {
            const double rest = double(low[i][k]);
            if (i >= count)
                expected.add(double(before[i][k]), 0);
            else if (k == 3 || position[i].w == 0)
                expected.add(rest, 0);
            else
            {
                const double v = double(velocity[i][k]), fall = gravity[k] * h * h;
                expected.add(v * h + fall + rest, std::abs(v) * h + std::abs(fall) + std::abs(rest));
            }
        }
    check_on_every_device(c);
}
