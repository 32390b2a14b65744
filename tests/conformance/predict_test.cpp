#include "taut/kernels/predict.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
struct Input
{
    std::vector<glm::vec<4, Real>> position, low, velocity;
    layout::StepValues<Real> step{};

    Input(std::uint32_t count, std::uint64_t seed)
    {
        Random random(seed);
        position = random.vec4s<Real>(count + 7, 1, 0, 0);
        for (auto& p : position)
            p.w = random.inverse_mass<Real>();
        low = random.vec4s<Real>(count + 7, 1e-8, 0, 1e-2);
        velocity = random.vec4s<Real>(count + 7, 3, -1, 1);
        step.substep = Real(1.0 / 600);
        step.gravity_x = Real(0.5);
        step.gravity_y = Real(-9.81);
        step.gravity_z = Real(0.25);
        step.max_speed = Real(10);
        plant(count);
    }

    /// Held and fast; too fast; exactly on the limit (no gravity along x would be needed: just below); not a
    /// number.
    void plant(std::uint32_t count)
    {
        const auto put = [&](std::uint32_t i, Real w, glm::vec<4, Real> v) {
            if (i < count)
            {
                position[i].w = w;
                velocity[i] = v;
            }
        };
        const Real nan = std::numeric_limits<Real>::quiet_NaN();
        put(0, Real(2), {Real(300), Real(-400), Real(0), Real(0)});
        put(1, Real(0), {Real(300), Real(-400), Real(0), Real(0)});
        put(2, Real(1), {Real(9.99), Real(0), Real(0), Real(0)});
        put(3, Real(1), {nan, Real(0), Real(0), Real(0)});
        put(4, Real(0), {nan, Real(0), Real(0), Real(0)});
        put(5, Real(1), {Real(1e15), Real(1e15), Real(-1e15), Real(0)});
    }
};

/// Free flight of one component of a vertex for h, with the speed limited.
template <typename Real>
void expect(const Input<Real>& in, std::uint32_t i, Field& field, Events& events)
{
    const auto d = [](Real x) { return static_cast<double>(x); };
    const double h = d(in.step.substep), limit = d(in.step.max_speed);
    const double gravity[3] = {d(in.step.gravity_x), d(in.step.gravity_y), d(in.step.gravity_z)};
    double v[3], square = 0;
    for (int k = 0; k < 3; ++k)
    {
        v[k] = d(in.velocity[i][k]) + gravity[k] * h;
        square += v[k] * v[k];
    }
    const bool held = in.position[i].w == 0;
    const bool fast = !held && std::sqrt(square) > limit; // not where it is no number
    const double factor = fast ? limit / std::sqrt(square) : 1;
    events[TAUT_EVENT_SPEED_CLAMP] += fast ? 1 : 0;
    for (int k = 0; k < 3; ++k)
    {
        const double low = d(in.low[i][k]);
        const double size =
            std::isnan(v[k]) ? 0 : std::abs(v[k] * factor * h) + std::abs(gravity[k]) * h * h;
        field.add(held ? low : v[k] * factor * h + low, held ? 0 : size + std::abs(low));
    }
    field.add(d(in.low[i].w), 0);
}

} // namespace

TEMPLATE_TEST_CASE(
    "predict moves free vertices along their velocity, limits speed, and carries what rounding lost", "",
    float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint64_t seed = 400 + count;
    CAPTURE(variant, count, seed);
    const Input<Real> in(count, seed);
    const auto before = Random(seed + 1).vec4s<Real>(count + 7, 1, 0, 1); // of delta and predicted

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(in.position)},
            {"low", bytes_of(in.low)},
            {"velocity", bytes_of(in.velocity)},
            {"delta", bytes_of(before)},
            {"predicted", bytes_of(before)},
            {"step_values", bytes_of(std::vector{in.step})},
            {"events", no_events()}};
    c.launches = {
        make_launch(kernels::predict::info(variant, c.precision), kernels::predict::Params{count}, count)};
    Field& expected = c.expected["delta"];
    for (std::uint32_t i = 0; i < count; ++i)
        expect(in, i, expected, c.events);
    for (std::uint32_t i = count; i < before.size(); ++i)
        for (int k = 0; k < 4; ++k)
            expected.add(static_cast<double>(before[i][k]), 0);
    if (variant == "kept")
        c.expected["predicted"] = Field(expected);
    check_on_every_device(c);
}
