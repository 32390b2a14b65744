#include "taut/kernels/plastic_spring.hpp"

#include "conformance/tolerances.hpp"
#include "support/expect.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace taut;
using namespace taut::conformance;

namespace {

/// 1 - exp(-x) as the kernel has it, and how far that may be from it.
double share_of(double x)
{
    const double grown = x + x * x / 2 + x * x * x / 6;
    return grown / (1 + grown);
}

template <typename Real>
layout::DistanceConstraint<Real> make_spring(layout::DistanceConstraint<Real>, std::uint32_t a,
                                             std::uint32_t b, Real rest)
{
    return {a, b, rest, Real(1e-4)};
}

template <typename Real>
layout::Spring<Real> make_spring(layout::Spring<Real>, std::uint32_t a, std::uint32_t b, Real rest)
{
    return {a, b, rest, Real(1e4), Real(0.5), 2};
}

template <typename Real, typename Record>
struct Input
{
    std::vector<glm::vec<4, Real>> position, low;
    std::vector<Record> spring;
    std::vector<std::uint32_t> record;
    std::vector<Real> rule;
    layout::StepValues<Real> step{};
};

/// Every other spring can flow, in an order of its own; strains on both sides of yields and limits.
template <typename Real, typename Record>
Input<Real, Record> make_input(Random& random, std::uint32_t count)
{
    static constexpr double kCreeps[] = {1e-3, 1, 30, 1e30};
    Input<Real, Record> in;
    in.position = random.vec4s<Real>(count + 9, 1, 0, 2);
    in.low = random.vec4s<Real>(count + 9, 1e-7, 0, 0);
    in.step.substep = Real(0.004);
    for (std::uint32_t k = 0; k < 2 * count; ++k)
    {
        const std::uint32_t a = random.below(count + 9), b = (a + 1 + random.below(5)) % (count + 9);
        const double length = glm::distance(glm::dvec3(in.position[a]), glm::dvec3(in.position[b]));
        const Real rest = static_cast<Real>(length * random.uniform(0.5, 2));
        in.spring.push_back(make_spring(Record{}, a, b, rest));
    }
    const std::vector<std::uint32_t> order = random.shuffled(count);
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const std::uint32_t k = 2 * order[i];
        in.record.push_back(k);
        const double first = static_cast<double>(in.spring[k].rest_length) * random.uniform(0.8, 1.2);
        in.rule.push_back(static_cast<Real>(first));
        in.rule.push_back(random.uniform<Real>(0.01, 0.6));
        in.rule.push_back(static_cast<Real>(kCreeps[random.below(4)]));
        in.rule.push_back(random.uniform<Real>(0.2, 0.5));
    }
    if (count > 2)
    {
        in.spring[in.record[0]].b = in.spring[in.record[0]].a; // no length: it flows to its limit
        const std::uint32_t at = in.record[1];                 // exactly at its own length
        in.position[in.spring[at].b] = in.position[in.spring[at].a];
        in.low[in.spring[at].b] = in.low[in.spring[at].a];
        in.position[in.spring[at].b].x += Real(0.5);
        in.position[in.spring[at].a].x = in.position[in.spring[at].b].x - Real(0.5);
        in.spring[at].rest_length = Real(0.5);
    }
    return in;
}

template <typename Real, typename Record>
void expect(const Input<Real, Record>& in, std::uint32_t i, double& value, double& scale)
{
    const Record& s = in.spring[in.record[i]];
    const double rest = in.rule[4 * i], yield = in.rule[4 * i + 1], creep = in.rule[4 * i + 2],
                 most = 1 + static_cast<double>(in.rule[4 * i + 3]);
    const glm::dvec3 xa = glm::dvec3(in.position[s.a]) + glm::dvec3(in.low[s.a]);
    const glm::dvec3 xb = glm::dvec3(in.position[s.b]) + glm::dvec3(in.low[s.b]);
    const double length = glm::distance(xa, xb), before = s.rest_length;
    const double strain = (length - before) / rest;
    const double flow = std::max(std::abs(strain) - yield, 0.0) *
                        share_of(std::min(creep * static_cast<double>(in.step.substep), 1e6)) * rest;
    const double after =
        std::clamp(before + (strain > 0 ? flow : -flow), rest / most, rest * most);
    // Only what flows is touched, and so it also is clamped.
    value = flow > 0 ? after : before;
    scale = flow > 0 ? before + length + rest : 0;
}

template <typename Real, typename Record>
void check_springs(std::uint32_t count, const char* variant)
{
    Random random(2600 + count);
    const auto in = make_input<Real, Record>(random, count);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"record", bytes_of(in.record)},    {"rule", bytes_of(in.rule)},
            {"spring", bytes_of(in.spring)},    {"position", bytes_of(in.position)},
            {"low", bytes_of(in.low)},          {"step_values", bytes_of(std::vector{in.step})}};
    c.launches = {make_launch(kernels::plastic_spring::info(variant, c.precision),
                              kernels::plastic_spring::Params{count}, count)};
    std::vector<double> value, scale;
    for (const Record& s : in.spring)
    {
        value.push_back(static_cast<double>(s.rest_length));
        scale.push_back(0);
    }
    std::size_t flowing = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        expect(in, i, value[in.record[i]], scale[in.record[i]]);
        flowing += scale[in.record[i]] > 0;
    }
    if (count > 60)
    {
        CHECK(flowing > count / 5);
        CHECK(flowing < count - count / 20);
    }
    const double unit = tolerance_of("plastic_spring") * (sizeof(Real) == 8 ? 0x1p-52 : 0x1p-23);
    const Bytes serial = run(*test_device("cpu:serial"), c.launches, c.in).at("spring");
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, c.precision))
            continue;
        CAPTURE(selector);
        const Bytes bytes = run(*device, c.launches, c.in).at("spring");
        const auto out = values_of<Record>(bytes);
        std::size_t wrong = 0, touched = 0;
        for (std::size_t k = 0; k < out.size(); ++k)
        {
            const double have = static_cast<double>(out[k].rest_length);
            wrong += !(scale[k] == 0 ? have == value[k] : std::abs(have - value[k]) <= unit * scale[k]);
            Record same = out[k];
            same.rest_length = in.spring[k].rest_length;
            touched += std::memcmp(&same, &in.spring[k], sizeof same) != 0;
        }
        CHECK(wrong == 0);
        CHECK(touched == 0); // nothing but rest lengths
        if (bitwise_equal_expected(device->info()))
            CHECK(bytes == serial);
        CHECK(device->counters().validation_messages == 0);
    }
}

} // namespace

TEST_CASE("the share that flows is that of the exponential law", "[plasticity]")
{
    for (const double x : {1e-6, 1e-3, 0.02, 0.1, 0.3})
        CHECK(std::abs(share_of(x) + std::expm1(-x)) < x * x * x * x / 24 + 1e-16);
    CHECK(share_of(1e6) == 1);
}

TEMPLATE_TEST_CASE("plastic_spring moves rest lengths towards lengths beyond the yield", "[plasticity]",
                   float, double)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    CAPTURE(count);
    check_springs<TestType, layout::DistanceConstraint<TestType>>(count, "");
    check_springs<TestType, layout::Spring<TestType>>(count, "force");
}
