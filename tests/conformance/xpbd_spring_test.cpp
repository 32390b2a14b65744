#include "taut/kernels/xpbd_spring.hpp"

#include "support/colours.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::conformance;
using kernels::xpbd_spring::Params;

namespace {

template <typename Real>
using Constraint = layout::DistanceConstraint<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;

/// XPBD by definition: C = |xa - xb| - L, gradient the direction n at a and -n at b,
/// dlambda = -(C + alpha/h^2 lambda) / (wa + wb + alpha/h^2), displacement w * gradient * dlambda.
template <typename Real>
void project(State& s, const Constraint<Real>& c, std::uint32_t k)
{
    const double wa = s.position[c.a].w, wb = s.position[c.b].w, rest = static_cast<double>(c.rest_length);
    const double soft = static_cast<double>(c.compliance) * s.inverse_substep * s.inverse_substep;
    const glm::dvec3 d = s.at(c.a) - s.at(c.b);
    const double length = glm::length(d);
    const double before = s.first_iteration ? 0 : s.multiplier[k];
    if (s.lambda)
        s.multiplier[k] = before;
    if (length == 0 || wa + wb == 0) // no direction, or nothing that could move
    {
        s.events[TAUT_EVENT_DEGENERATE] += s.report && wa + wb > 0 && rest > 0 ? 1 : 0;
        return;
    }
    const double lambda = s.lambda ? before : 0;
    const double dlambda = -(length - rest + soft * lambda) / (wa + wb + soft);
    // What was added: both ends' places, the rest length, the multiplier; a short d turns on its own
    // rounding.
    const double moved = glm::length(glm::dvec3(s.delta[c.a])) + glm::length(glm::dvec3(s.delta[c.b]));
    const double inherited = s.delta_scale[c.a] + s.delta_scale[c.b];
    const double size = length + moved + inherited;
    const double terms = size + rest + soft * std::abs(lambda);
    const double turn = std::abs(dlambda) * size / length;
    s.push(c.a, d * (wa * dlambda / length), wa * (terms / (wa + wb + soft) + turn));
    s.push(c.b, d * (-wb * dlambda / length), wb * (terms / (wa + wb + soft) + turn));
    if (!s.lambda)
        return;
    s.multiplier[k] = before + dlambda;
    s.multiplier_scale[k] = std::abs(before) + terms / (wa + wb + soft);
}

/// Adds a colour: `count` constraints between random disjoint pairs of `vertices` vertices from `base` on.
template <typename Real>
void add_colour(Input<Real>& in, Random& random, std::uint32_t count, std::uint32_t base,
                std::uint32_t vertices)
{
    const auto order = random.shuffled(vertices);
    static constexpr double kCompliances[] = {0, 1e-9, 1e-6, 1e-3};
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const Real rest = random.uniform<Real>(0.2, 2);
        const Real compliance = static_cast<Real>(kCompliances[random.below(4)]);
        in.constraint.push_back({base + order[2 * i], base + order[2 * i + 1], rest, compliance});
        in.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
    }
    in.colour_start.push_back(static_cast<std::uint32_t>(in.constraint.size()));
}

template <typename Real>
Input<Real> vertices(Random& random, std::uint32_t count)
{
    Input<Real> in;
    in.position = random.vec4s<Real>(count, 1, 0, 0);
    for (auto& p : in.position)
        p.w = random.inverse_mass<Real>();
    in.delta = random.vec4s<Real>(count, 1e-2, 0, 1e-3);
    in.step.inverse_substep = Real(600);
    return in;
}

template <typename Real>
void make_coincident(Input<Real>& in, std::uint32_t a, std::uint32_t b)
{
    in.position[b] = glm::vec<4, Real>(glm::vec<3, Real>(in.position[a]), in.position[b].w);
    in.delta[b] = glm::vec<4, Real>(glm::vec<3, Real>(in.delta[a]), in.delta[b].w);
}

/// The elements that divide by zero if nobody looks, at the front of the first colour, as far as there is
/// room.
template <typename Real>
void plant(Input<Real>& in)
{
    const auto first = in.constraint.begin() + in.colour_start[1];
    const std::uint32_t count = in.colour_start[2] - in.colour_start[1];
    const auto masses = [&](std::uint32_t k, Real wa, Real wb) {
        in.position[first[k].a].w = wa;
        in.position[first[k].b].w = wb;
    };
    if (count < 9)
        return;
    make_coincident(in, first[0].a, first[0].b); // no direction: skipped, counted
    masses(0, Real(1), Real(2));
    make_coincident(in, first[1].a, first[1].b); // already as its rest length wants: not counted
    masses(1, Real(1), Real(2));
    first[1].rest_length = 0;
    masses(2, Real(0), Real(0)); // nothing can move, only the multiplier: not counted
    first[2].compliance = Real(1e-6);
    masses(6, Real(0), Real(0)); // rigid between held ends: no multiplier either, not counted
    first[6].compliance = 0;
    make_coincident(in, first[3].a, first[3].b); // neither
    masses(3, Real(0), Real(0));
    first[4].rest_length = 0; // pulls together
    masses(4, Real(1), Real(2));
    make_coincident(in, first[5].a, first[5].b); // one end free: counted
    masses(5, Real(0), Real(2));
    first[7].compliance = Real(1e12); // as good as absent
    masses(7, Real(1e-6), Real(1));   // mass ratio of a million
    masses(8, Real(0), Real(3));      // one end held
    first[8].compliance = 0;
}

} // namespace

TEMPLATE_TEST_CASE("a distance constraint moves both ends by the XPBD formula", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    mode.report = GENERATE(true, false);
    const std::uint64_t seed = 600 + count;
    CAPTURE(count, mode.variant(), mode.first_iteration, mode.report, seed);
    Random random(seed);
    const std::uint32_t size = 2 * std::max(count, 5u) + 7;
    auto in = vertices<Real>(random, size);
    for (const std::uint32_t n :
         {5u, count, 5u}) // before and after: other colours, which must not be touched
        add_colour(in, random, n, 0, size);
    in.groups = {{1, 2}};
    plant(in);
    check_colours<Params>(kernels::xpbd_spring::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("the tail of a colouring gives what one distance dispatch per colour gives, bit for bit",
                   "", float, double)
{
    using Real = TestType;
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    const std::uint64_t seed = 650;
    CAPTURE(mode.lambda, mode.first_iteration, seed);
    Random random(seed);
    auto in = vertices<Real>(random, 1000); // few, so that colours share vertices
    for (const std::uint32_t count : {5u, 64u, 1u, 63u, 65u, 200u})
        add_colour(in, random, count, 0, 500);
    for (const std::uint32_t count : {9u, 100u, 3u}) // a second body, a group of its own
        add_colour(in, random, count, 500, 490);
    add_colour(in, random, 5, 990, 10); // a third
    add_colour(in, random, 4, 0, 1000); // belongs to no group
    in.groups = {{1, 6}, {6, 9}, {9, 10}};
    plant(in);
    check_tail_equals_dispatches<Params>(kernels::xpbd_spring::info, in, mode, precision_of<Real>());
    mode.tail = true;
    check_colours<Params>(kernels::xpbd_spring::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("the first distance iteration with multipliers moves vertices bitwise as the one without",
                   "", float, double)
{
    using Real = TestType;
    const std::uint64_t seed = 660;
    CAPTURE(seed);
    Random random(seed);
    auto in = vertices<Real>(random, 2100);
    add_colour(in, random, 100, 0, 2100);
    add_colour(in, random, 1000, 0, 2100);
    in.groups = {{0, 2}};
    plant(in);
    check_first_iteration_equals_base<Params>(kernels::xpbd_spring::info, in, precision_of<Real>());
}

TEMPLATE_TEST_CASE(
    "ends a hair apart are moved along their direction or counted as degenerate, never to infinity", "",
    float, double)
{
    using Real = TestType;
    const double gap = GENERATE(1e-30, 1e-20, 1e-18, 1e-10);
    CAPTURE(gap);
    Input<Real> in;
    in.position = {{Real(0.5), Real(1), Real(-2), Real(1)}, {Real(0.5), Real(1), Real(-2), Real(3)}};
    in.delta = {{static_cast<Real>(gap), Real(0), Real(0), Real(0)}, {Real(0), Real(0), Real(0), Real(0)}};
    in.step.inverse_substep = Real(600);
    in.constraint = {{0, 1, Real(0.25), Real(0)}};
    in.colour_start = {0, 1};
    in.groups = {{0, 1}};
    const auto launches =
        colour_launches<Params>(kernels::xpbd_spring::info, precision_of<Real>(), Mode(), in);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, launches, in.buffers());
        const auto delta = values_of<glm::vec<4, Real>>(out.at("delta"));
        const auto degenerate = values_of<std::uint32_t>(out.at("events"))[TAUT_EVENT_DEGENERATE];
        // The square of a length below 1e-19 is not a normal float.
        const bool may_skip = sizeof(Real) == 4 && gap < 1e-19;
        CHECK((degenerate == 0 || (may_skip && degenerate == 1)));
        const double rest = degenerate != 0 ? gap : 0.25, precision = may_skip ? 1e-3 : 1e-6;
        CHECK(static_cast<double>(delta[0].x - delta[1].x) == Approx(rest).epsilon(precision).margin(1e-40));
        if (degenerate == 0)
            CHECK(static_cast<double>(delta[0].x) ==
                  Approx(0.0625).epsilon(precision)); // by inverse mass 1 : 3
        CHECK((delta[0].y == 0 && delta[0].z == 0 && delta[1].y == 0 && delta[1].z == 0));
    }
}

namespace {

/// With a damper of `time` times the stiffness: dlambda = -(C + alpha/h^2 lambda + gamma n.(da - db)) /
/// ((1 + gamma) (wa + wb) + alpha/h^2), gamma = time / h.
template <typename Real>
void project_damped(State& s, const Constraint<Real>& c, std::uint32_t k, double time)
{
    const double wa = s.position[c.a].w, wb = s.position[c.b].w, rest = static_cast<double>(c.rest_length);
    const double soft = static_cast<double>(c.compliance) * s.inverse_substep * s.inverse_substep;
    const double gamma = time * s.inverse_substep, total = (1 + gamma) * (wa + wb) + soft;
    const glm::dvec3 d = s.at(c.a) - s.at(c.b);
    const double length = glm::length(d);
    const double before = s.lambda && !s.first_iteration ? s.multiplier[k] : 0;
    if (s.lambda)
        s.multiplier[k] = before;
    if (length == 0 || wa + wb == 0)
    {
        s.events[TAUT_EVENT_DEGENERATE] += s.report && wa + wb > 0 && rest > 0 ? 1 : 0;
        return;
    }
    const glm::dvec3 apart(s.delta[c.a] - s.delta[c.b]);
    const double dlambda = -(length - rest + soft * before + gamma * glm::dot(d, apart) / length) / total;
    const double moved = glm::length(glm::dvec3(s.delta[c.a])) + glm::length(glm::dvec3(s.delta[c.b]));
    const double size = length + moved + s.delta_scale[c.a] + s.delta_scale[c.b];
    const double terms = size + rest + soft * std::abs(before) + gamma * moved * size / length;
    const double turn = std::abs(dlambda) * size / length;
    s.push(c.a, d * (wa * dlambda / length), wa * (terms / total + turn));
    s.push(c.b, d * (-wb * dlambda / length), wb * (terms / total + turn));
    if (!s.lambda)
        return;
    s.multiplier[k] = before + dlambda;
    s.multiplier_scale[k] = std::abs(before) + terms / total;
}

} // namespace

TEMPLATE_TEST_CASE("a spring with a damper moves both ends by the damped XPBD formula", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 129u, 1000u);
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.tail = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    CAPTURE(count, mode.variant(), mode.first_iteration);
    Random random(670 + count);
    const std::uint32_t size = 2 * std::max(count, 5u) + 7;
    auto in = vertices<Real>(random, size);
    for (const std::uint32_t n : {5u, count, 5u})
        add_colour(in, random, n, 0, size);
    in.groups = {{1, 3}};
    plant(in);
    static constexpr double kTimes[] = {0, 1e-4, 1e-2, 1};
    std::vector<Real> times;
    for (std::size_t k = 0; k < in.constraint.size(); ++k)
        times.push_back(static_cast<Real>(kTimes[random.below(4)]));
    Case c;
    c.precision = precision_of<Real>();
    c.in = in.buffers();
    c.in["damping_time"] = bytes_of(times);
    c.launches = colour_launches<Params>(
        [](std::string_view variant, Precision precision) -> const KernelInfo& {
            const std::string damped = variant.empty() ? "damped" : "damped_" + std::string(variant);
            return kernels::xpbd_spring::info(damped, precision);
        },
        c.precision, mode, in);
    State state = state_of(in, mode.lambda, mode.first_iteration, mode.report);
    for (std::uint32_t k = in.colour_start[1]; k < in.colour_start[3]; ++k)
        project_damped(state, in.constraint[k], k, static_cast<double>(times[k]));
    c.expected["delta"] = state.delta_field();
    if (mode.lambda)
        c.expected["multiplier"] = {state.multiplier, state.multiplier_scale};
    c.events = state.events;
    check_on_every_device(c);
}
