#include "taut/kernels/xpbd_hinge.hpp"

#include "support/colours.hpp"
#include "support/hinges.hpp"

#include <glm/vec2.hpp>

#include <algorithm>

using namespace taut;
using namespace taut::conformance;
using kernels::xpbd_hinge::Params;

namespace {

template <typename Real>
using Constraint = layout::BendingConstraint<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;

/// XPBD by definition, with the angle as the constraint: dlambda = -(C + alpha/h^2 lambda) / (sum w |g|^2 +
/// alpha/h^2), each vertex moves by w g dlambda. A hinge without two areas has no angle.
template <typename Real>
void project(State& s, const Constraint<Real>& c, std::uint32_t k)
{
    const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
    Corners x;
    double masses = 0, size = 0, inherited = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        x[v] = s.at(vertex[v]);
        masses += s.position[vertex[v]].w;
        size = std::max(size, glm::length(x[v] - x[0]));
        inherited += s.delta_scale[vertex[v]];
    }
    const double thin = std::min(height(x[2], x[0], x[1] - x[0]), height(x[3], x[0], x[1] - x[0]));
    const double before = s.lambda && !s.first_iteration ? s.multiplier[k] : 0;
    if (s.lambda)
        s.multiplier[k] = before;
    if (thin <= 1e-5 * size || masses == 0)
    {
        s.events[TAUT_EVENT_DEGENERATE] += s.report && masses > 0 ? 1 : 0;
        return;
    }
    const Dual<12> angle = hinge_angle(x);
    const double soft = static_cast<double>(c.compliance) * s.inverse_substep * s.inverse_substep;
    double weight = 0;
    for (std::size_t i = 0; i < 12; ++i)
        weight += s.position[vertex[i / 3]].w * angle.slope[i] * angle.slope[i];
    const double value = std::remainder(angle.value - static_cast<double>(c.rest_angle), 2 * kPi);
    const double dlambda = -(value + soft * before) / (weight + soft);
    // A thin triangle turns with the rounding of its corners: that many times more of everything.
    const double shape = (size + inherited) / thin;
    const double terms =
        (kPi * shape + soft * std::abs(before)) / (weight + soft) + std::abs(dlambda) * shape;
    for (std::size_t v = 0; v < 4; ++v)
    {
        const glm::dvec3 g(angle.slope[3 * v], angle.slope[3 * v + 1], angle.slope[3 * v + 2]);
        const double w = s.position[vertex[v]].w;
        s.push(vertex[v], g * (w * dlambda), w * terms / thin);
    }
    if (s.lambda)
    {
        s.multiplier[k] = before + dlambda;
        s.multiplier_scale[k] = std::abs(before) + terms;
    }
}

/// Adds a colour of `count` hinges with vertices of their own from `base` on, and returns the next free
/// vertex.
template <typename Real>
void add_hinges(Input<Real>& in, Random& random, std::uint32_t count)
{
    static constexpr double kCompliances[] = {0, 1e-7, 1e-4, 1};
    const auto base = static_cast<std::uint32_t>(in.position.size());
    const auto order = random.shuffled(4 * count);
    in.position.resize(base + 4 * count);
    const auto more = random.vec4s<Real>(4 * count, 1e-2, 0, 1e-3);
    in.delta.insert(in.delta.end(), more.begin(), more.end());
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const Corners x = random_hinge(random);
        for (std::uint32_t v = 0; v < 4; ++v)
            in.position[base + order[4 * i + v]] = with_weight(x[v], random.inverse_mass<Real>());
        const std::uint32_t* at = &order[4 * i];
        // Not near half a turn from rest, where both ways are right.
        const double rest = std::remainder(hinge_angle(x).value + random.uniform(-2.8, 2.8), 2 * kPi);
        const Real compliance = static_cast<Real>(kCompliances[random.below(4)]);
        in.constraint.push_back(
            {base + at[0], base + at[1], base + at[2], base + at[3], static_cast<Real>(rest), compliance});
        in.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
    }
    in.colour_start.push_back(static_cast<std::uint32_t>(in.constraint.size()));
    in.step.inverse_substep = Real(600);
}

/// A colour that reuses vertices of earlier hinges: every hinge with its two wings exchanged for its edge.
template <typename Real>
void add_turned(Input<Real>& in, std::uint32_t colour)
{
    for (std::uint32_t k = in.colour_start[colour]; k < in.colour_start[colour + 1]; ++k)
    {
        Constraint<Real> c = in.constraint[k];
        std::swap(c.edge0, c.wing0);
        c.rest_angle = -c.rest_angle * Real(0.5);
        c.compliance = Real(1e-4);
        in.constraint.push_back(c);
        in.multiplier.push_back(Real(1e-4));
    }
    in.colour_start.push_back(static_cast<std::uint32_t>(in.constraint.size()));
}

/// Hinges that have no angle, or one at the border of its range.
template <typename Real>
void plant(Input<Real>& in, std::uint32_t colour)
{
    const auto specials = special_hinges();
    const std::uint32_t first = in.colour_start[colour], count = in.colour_start[colour + 1] - first;
    if (count < std::size(specials))
        return;
    for (std::uint32_t i = 0; i < std::size(specials); ++i)
    {
        Constraint<Real>& c = in.constraint[first + i];
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        for (std::size_t v = 0; v < 4; ++v)
        {
            in.position[vertex[v]] = with_weight(specials[i].x[v], static_cast<Real>(specials[i].w[v]));
            in.delta[vertex[v]] = glm::vec<4, Real>(Real(0));
        }
        c.rest_angle = static_cast<Real>(specials[i].rest);
        c.compliance = Real(1e-6);
    }
}

} // namespace

TEST_CASE("the derivatives that judge the bending kernel are those of the angle")
{
    Random random(42);
    for (int i = 0; i < 100; ++i)
    {
        const Corners x = random_hinge(random);
        const Dual<12> angle = hinge_angle(x);
        for (std::size_t k = 0; k < 12; ++k)
        {
            constexpr double kStep = 1e-5;
            Corners more = x, less = x;
            more[k / 3][static_cast<int>(k % 3)] += kStep;
            less[k / 3][static_cast<int>(k % 3)] -= kStep;
            const double turn = std::remainder(hinge_angle(more).value - hinge_angle(less).value, 2 * kPi);
            CHECK(angle.slope[k] == Approx(turn / (2 * kStep)).epsilon(1e-6).margin(1e-7));
        }
    }
}

TEMPLATE_TEST_CASE("a hinge moves its four vertices by the XPBD formula", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    mode.report = GENERATE(true, false);
    const std::uint64_t seed = 800 + count;
    CAPTURE(count, mode.variant(), mode.first_iteration, mode.report, seed);
    Random random(seed);
    Input<Real> in;
    for (const std::uint32_t n :
         {5u, count, 5u}) // before and after: other colours, which must not be touched
        add_hinges(in, random, n);
    in.groups = {{1, 2}};
    plant(in, 1);
    check_colours<Params>(kernels::xpbd_hinge::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("the tail of a colouring gives what one bending dispatch per colour gives, bit for bit",
                   "", float, double)
{
    using Real = TestType;
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    const std::uint64_t seed = 850;
    CAPTURE(mode.lambda, mode.first_iteration, seed);
    Random random(seed);
    Input<Real> in;
    for (const std::uint32_t n : {3u, 64u, 65u, 1u, 200u}) // colours 0..4
        add_hinges(in, random, n);
    for (const std::uint32_t colour : {1u, 2u, 4u}) // 5, 6, 7
        add_turned(in, colour);
    in.groups = {{1, 3}, {4, 5}}; // another body in a group of its own
    plant(in, 2);
    mode.tail = true;
    check_colours<Params>(kernels::xpbd_hinge::info, in, mode, precision_of<Real>(), project<Real>);
    in.groups = {{1, 8}}; // these share vertices, so their order is what counts
    check_tail_equals_dispatches<Params>(kernels::xpbd_hinge::info, in, mode, precision_of<Real>());
}

TEMPLATE_TEST_CASE("the first bending iteration with multipliers moves vertices bitwise as the one without",
                   "", float, double)
{
    using Real = TestType;
    const std::uint64_t seed = 860;
    CAPTURE(seed);
    Random random(seed);
    Input<Real> in;
    add_hinges(in, random, 100);
    add_hinges(in, random, 1000);
    in.groups = {{0, 2}};
    plant(in, 1);
    check_first_iteration_equals_base<Params>(kernels::xpbd_hinge::info, in, precision_of<Real>());
}

namespace {

/// Hinges about the x axis whose angle is that of the vector (-y, -z) of the second wing; only that wing
/// moves, rest angle zero. So one iteration leaves the multiplier -angle * (y^2 + z^2).
template <typename Real>
Input<Real> angle_sweep(const std::vector<glm::dvec2>& wings)
{
    Input<Real> in;
    for (const glm::dvec2& wing : wings)
    {
        const auto base = static_cast<std::uint32_t>(in.position.size());
        for (const glm::dvec3& x : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)})
            in.position.push_back(with_weight(x, Real(0)));
        in.position.push_back(with_weight({0, wing.x, wing.y}, Real(1)));
        in.constraint.push_back({base, base + 1, base + 2, base + 3, Real(0), Real(0)});
        in.multiplier.push_back(Real(0));
    }
    in.delta.resize(in.position.size(), glm::vec<4, Real>(Real(0)));
    in.colour_start = {0, static_cast<std::uint32_t>(wings.size())};
    in.groups = {{0, 1}};
    in.step.inverse_substep = Real(1);
    return in;
}

std::vector<glm::dvec2> all_round()
{
    std::vector<glm::dvec2> wings;
    for (int i = -5000; i <= 5000; ++i)
        wings.emplace_back(-std::cos(i * kPi / 5000), -std::sin(i * kPi / 5000));
    for (const double small : {1e-30, 1e-20, 1e-10, 1e-7, 1e-4, 1e-2}) // near flat, near folded, near upright
        for (const double sign : {-1.0, 1.0})
        {
            wings.emplace_back(-1, sign * small);
            wings.emplace_back(1, sign * small);
            wings.emplace_back(sign * small, 1);
            wings.emplace_back(sign * small, -1);
        }
    for (const double x : {-1.0, 1.0}) // exact eighths of a turn
        for (const double y : {-1.0, 1.0})
            wings.emplace_back(x, y);
    return wings;
}

} // namespace

TEMPLATE_TEST_CASE("the angle is right to a few units of the last place all the way round", "", float, double)
{
    using Real = TestType;
    const auto in = angle_sweep<Real>(all_round());
    Mode mode;
    mode.lambda = true;
    const Precision precision = precision_of<Real>();
    const auto launches = colour_launches<Params>(kernels::xpbd_hinge::info, precision, mode, in);
    const double absolute =
        sizeof(Real) == 8 ? 4e-15 : 1.5e-6; // four and a half units of the last place of pi
    const double relative = sizeof(Real) == 8 ? 4e-15 : 1.5e-6; // near flat: of the angle itself
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        const auto multiplier = reals_of<Real>(run(*device, launches, in.buffers()).at("multiplier"));
        double worst = 0, worst_relative = 0;
        for (std::size_t i = 0; i < multiplier.size(); ++i)
        {
            const double y = static_cast<double>(in.position[4 * i + 3].y),
                         z = static_cast<double>(in.position[4 * i + 3].z);
            const double angle = std::atan2(-z, -y), found = -multiplier[i] / (y * y + z * z);
            const double error = std::abs(std::remainder(found - angle, 2 * kPi));
            worst = std::max(worst, error);
            if (angle != 0)
                worst_relative = std::max(worst_relative, error / std::abs(angle));
        }
        CHECK(worst < absolute);
        CHECK(worst_relative < relative);
    }
}

TEMPLATE_TEST_CASE("a hinge folded shut with a flat rest angle opens by a finite step", "", float, double)
{
    using Real = TestType;
    auto in = angle_sweep<Real>({{1, 0}});
    in.constraint[0].compliance = Real(1);
    const auto launches =
        colour_launches<Params>(kernels::xpbd_hinge::info, precision_of<Real>(), Mode(), in);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto delta = values_of<glm::vec<4, Real>>(run(*device, launches, in.buffers()).at("delta"));
        CHECK(std::abs(static_cast<double>(delta[3].z)) ==
              Approx(kPi / 2)); // gradient 1, weight 1, compliance 1
        CHECK((delta[3].x == 0 && std::abs(delta[3].y) < Real(1e-6)));
    }
}
