#include "taut/kernels/force_kick.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("force_kick adds its shares of h (force / mass) and h gravity to what moves", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::array<float, 2> share =
        GENERATE(std::array<float, 2>{1, 0}, std::array<float, 2>{0, -1}, std::array<float, 2>{0.5f, 0.5f});
    CAPTURE(count, share[0], share[1]);
    Random random(980 + count);
    auto position = random.vec4s<Real>(count + 7, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    auto force = random.vec4s<Real>(count + 7, 30, -1, 1);
    if (count > 5)
    {
        force[3].y = std::numeric_limits<Real>::infinity(); // not taken, counted
        force[4].z = std::numeric_limits<Real>::quiet_NaN();
        force[5].x = Real(1e30);
        position[3].w = position[4].w = position[5].w = Real(1);
    }
    const auto velocity = random.vec4s<Real>(count + 7, 3, -1, 1);
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    step.gravity_x = Real(0.5);
    step.gravity_y = Real(-9.81);
    step.gravity_z = Real(2);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},
            {"force", bytes_of(force)},
            {"velocity", bytes_of(velocity)},
            {"step_values", bytes_of(std::vector{step})},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::force_kick::info("", c.precision),
                              kernels::force_kick::Params{count, share[0], share[1]}, count)};
    Field& expected = c.expected["velocity"];
    const double h = double(step.substep);
    const double gravity[] = {double(step.gravity_x), double(step.gravity_y), double(step.gravity_z)};
    for (std::uint32_t i = 0; i < velocity.size(); ++i)
    {
        const bool wild = count > 5 && i >= 3 && i <= 5 && share[0] != 0;
        // Infinity or NaN times a share of zero is no number either.
        const bool dropped = wild || (count > 5 && (i == 3 || i == 4));
        c.events[TAUT_EVENT_NON_FINITE] += dropped ? 1 : 0;
        for (int k = 0; k < 4; ++k)
        {
            const double v = double(velocity[i][k]), w = double(position[i].w);
            const bool moves = i < count && w > 0 && !dropped;
            if (!moves || k == 3)
            {
                expected.add(moves ? 0 : v, 0);
                continue;
            }
            const double a = double(force[i][k]) * w * h * double(share[0]);
            const double b = gravity[k] * h * double(share[1]);
            expected.add(v + a + b, std::abs(v) + std::abs(a) + std::abs(b));
        }
    }
    check_on_every_device(c);
}
