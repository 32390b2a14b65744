#include "taut/kernels/finish.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
using Vec4s = std::vector<glm::vec<4, Real>>;

/// One vertex as the file of methods has it: v = (x_new - x_old) / h, x = x_new; a step that is not finite or
/// leaves the world is not taken.
template <typename Real>
void expect(const glm::vec<4, Real>& x, const glm::vec<4, Real>& low, const glm::vec<4, Real>& delta,
            double h, Case& c)
{
    double size = 0;
    for (int k = 0; k < 3; ++k)
        size += std::abs(static_cast<double>(x[k])) + std::abs(static_cast<double>(delta[k]));
    const bool taken = std::isfinite(size) && size < 1e18;
    c.events[TAUT_EVENT_NON_FINITE] += taken ? 0 : 1;
    for (int k = 0; k < 3; ++k)
    {
        const double at = static_cast<double>(x[k]), lost = static_cast<double>(low[k]);
        const double step = taken ? static_cast<double>(delta[k]) : lost;
        c.expected["position"].add(at + step, std::abs(at + step));
        c.expected["velocity"].add(taken ? (step - lost) / h : 0,
                                   taken ? (std::abs(step) + std::abs(lost)) / h : 0);
        // The remainder is less than half a unit of the position; its value has a test of its own below.
        c.expected["low"].add(0, std::abs(at + step));
        c.expected["delta"].add(taken ? static_cast<double>(delta[k]) : lost, 0);
    }
    c.expected["position"].add(static_cast<double>(x.w), 0);
    c.expected["velocity"].add(0, 0);
    c.expected["low"].add(static_cast<double>(low.w), 0);
    c.expected["delta"].add(static_cast<double>(taken ? delta.w : low.w), 0);
}

template <typename Real>
void plant(Vec4s<Real>& delta, std::uint32_t count)
{
    const Real nan = std::numeric_limits<Real>::quiet_NaN(), inf = std::numeric_limits<Real>::infinity();
    const Real bad[] = {nan, inf, -inf, Real(1e19), Real(-1e30)};
    for (std::uint32_t i = 0; i < 5 && 2 * i < count; ++i)
        delta[2 * i][static_cast<int>(i % 3)] = bad[i];
    if (count > 10)
        delta[10] = {nan, inf, -inf, delta[10].w};
    if (count > 11)
        delta[11].x = Real(1e17); // far, but squares stay finite in float: kept
}

} // namespace

TEMPLATE_TEST_CASE(
    "finish takes the displacement into position and velocity and drops one that is not finite", "", float,
    double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint64_t seed = 500 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const Vec4s<Real> position = random.vec4s<Real>(count + 7, 5, 0, 2);
    const Vec4s<Real> low = random.vec4s<Real>(count + 7, 1e-8, 0, 1e-2);
    const Vec4s<Real> velocity = random.vec4s<Real>(count + 7, 1, -1, 1);
    Vec4s<Real> delta = random.vec4s<Real>(count + 7, 1e-3, 0, 1e-2);
    plant(delta, count);
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)}, {"low", bytes_of(low)},
            {"velocity", bytes_of(velocity)}, {"delta", bytes_of(delta)},
            {"events", no_events()},          {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::finish::info("", c.precision), kernels::finish::Params{count}, count)};
    for (std::uint32_t i = 0; i < count; ++i)
        expect(position[i], low[i], delta[i], static_cast<double>(step.substep), c);
    for (std::uint32_t i = count; i < position.size(); ++i)
        for (int k = 0; k < 4; ++k)
        {
            c.expected["position"].add(static_cast<double>(position[i][k]), 0);
            c.expected["velocity"].add(static_cast<double>(velocity[i][k]), 0);
            c.expected["low"].add(static_cast<double>(low[i][k]), 0);
            c.expected["delta"].add(static_cast<double>(delta[i][k]), 0);
        }
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("position and low together hold the sum of position and displacement without any loss", "",
                   float, double)
{
    using Real = TestType;
    // Multiples of 2^-62 below 1, so that 64-bit integers can add them exactly.
    constexpr int kDigits = std::numeric_limits<Real>::digits;
    const std::uint32_t count = 1000;
    const std::uint64_t seed = 550;
    CAPTURE(seed);
    Random random(seed);
    const auto draw = [&](int exponent) {
        const double mantissa = std::floor(random.uniform(-1, 1) * std::ldexp(1.0, kDigits - 1));
        return static_cast<Real>(std::ldexp(mantissa, exponent - kDigits));
    };
    Vec4s<Real> position(count), delta(count), none(count, glm::vec<4, Real>(Real(0)));
    for (std::uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
        {
            position[i][k] = draw(0);
            delta[i][k] = draw(-static_cast<int>(i % 10)); // from as large as the position to a thousandth
        }
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    const Buffers in = {{"position", bytes_of(position)}, {"low", bytes_of(none)},
                        {"velocity", bytes_of(none)},     {"delta", bytes_of(delta)},
                        {"events", no_events()},          {"step_values", bytes_of(std::vector{step})}};
    const Launch launch =
        make_launch(kernels::finish::info("", precision_of<Real>()), kernels::finish::Params{count}, count);
    const auto fixed = [](Real x) { return static_cast<std::int64_t>(std::ldexp(x, 62)); };
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, {launch}, in);
        const auto high = values_of<glm::vec<4, Real>>(out.at("position"));
        const auto low = values_of<glm::vec<4, Real>>(out.at("low"));
        std::uint32_t exact = 0;
        for (std::uint32_t i = 0; i < count; ++i)
            for (int k = 0; k < 3; ++k)
                exact += fixed(high[i][k]) + fixed(low[i][k]) == fixed(position[i][k]) + fixed(delta[i][k])
                             ? 1
                             : 0;
        CHECK(exact == 3 * count);
    }
}
