#include "taut/kernels/xpbd_hub_spring.hpp"

#include "support/colours.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::xpbd_hub_spring::Params;

namespace {

template <typename Real>
using Constraint = layout::DistanceConstraint<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;

/// Mass splitting: n copies of the hub with 1/n of its mass each solve one constraint; the hub moves by the
/// mean of its copies.
template <typename Real>
void solve_hub(State& s, const std::vector<Constraint<Real>>& constraint, std::uint32_t first,
               std::uint32_t n)
{
    const std::uint32_t hub = constraint[first].a;
    const double w_copy = s.position[hub].w * n;
    const glm::dvec3 start = s.at(hub);
    glm::dvec3 copies(0);
    double copies_size = 0;
    for (std::uint32_t k = first; k < first + n; ++k)
    {
        const Constraint<Real>& c = constraint[k];
        const double w = s.position[c.b].w, rest = static_cast<double>(c.rest_length);
        const double soft = static_cast<double>(c.compliance) * s.inverse_substep * s.inverse_substep;
        const double before = s.lambda && !s.first_iteration ? s.multiplier[k] : 0;
        const glm::dvec3 d = start - s.at(c.b);
        const double length = glm::length(d);
        if (s.lambda)
            s.multiplier[k] = before;
        if (length == 0 || w_copy + w == 0)
        {
            s.events[TAUT_EVENT_DEGENERATE] += s.report && w_copy + w > 0 && rest > 0 ? 1 : 0;
            continue;
        }
        const double total = w_copy + w + soft;
        const double dlambda = -(length - rest + soft * before) / total;
        const double size =
            length + glm::length(glm::dvec3(s.delta[c.b])) + glm::length(glm::dvec3(s.delta[hub]));
        const double terms =
            (size + rest + soft * std::abs(before)) / total + std::abs(dlambda) * size / length;
        copies += d * (w_copy * dlambda / length);
        copies_size += w_copy * terms;
        s.push(c.b, d * (-w * dlambda / length), w * terms);
        if (s.lambda)
        {
            s.multiplier[k] = before + dlambda;
            s.multiplier_scale[k] = std::abs(before) + terms;
        }
    }
    s.push(hub, copies / double(n), copies_size / n);
}

/// A star of n spokes around vertex 0 with two spokes of another hub before and after.
template <typename Real>
Input<Real> star(std::uint32_t n, Real hub_weight, std::uint64_t seed)
{
    Random random(seed);
    Input<Real> in;
    in.position = random.vec4s<Real>(n + 6, 1, 0, 0);
    for (auto& p : in.position)
        p.w = random.inverse_mass<Real>();
    in.position[0].w = hub_weight;
    in.delta = random.vec4s<Real>(n + 6, 1e-2, 0, 1e-3);
    in.step.inverse_substep = Real(600);
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        const Real rest = random.uniform<Real>(0.2, 2),
                   compliance = random.chance(0.5) ? Real(0) : Real(1e-6);
        in.constraint.push_back({a, b, rest, compliance});
        in.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
    };
    const std::uint32_t other = n + 1;
    add(other, n + 2);
    add(other, n + 3);
    const auto spokes = random.shuffled(n);
    for (const std::uint32_t spoke : spokes)
        add(0, spoke + 1);
    add(other, n + 4);
    add(other, n + 5);
    return in;
}

template <typename Real>
void plant(Input<Real>& in, std::uint32_t n)
{
    if (n < 4)
        return;
    const std::uint32_t same = in.constraint[2].b, rest_zero = in.constraint[3].b, held = in.constraint[4].b;
    for (const std::uint32_t v : {same, rest_zero})
    {
        in.position[v] = glm::vec<4, Real>(glm::vec<3, Real>(in.position[0]), Real(1));
        in.delta[v] = glm::vec<4, Real>(glm::vec<3, Real>(in.delta[0]), in.delta[v].w);
    }
    in.constraint[3].rest_length = 0; // coincident as it should be: not counted
    in.position[held].w = 0;
}

} // namespace

TEMPLATE_TEST_CASE("a hub moves by the mean of its copies and every spoke by its own constraint", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t n = GENERATE(1u, 2u, 63u, 64u, 65u, 1000u, 10000u);
    const double weight = GENERATE(1.0, 0.0, 1e-3);
    const bool lambda = GENERATE(false, true), first_iteration = GENERATE(true, false);
    const bool report = weight != 1e-3;
    const std::uint64_t seed = 700 + n;
    CAPTURE(n, weight, lambda, first_iteration, seed);
    auto in = star<Real>(n, static_cast<Real>(weight), seed);
    plant(in, n);

    Case c;
    c.precision = precision_of<Real>();
    c.in = in.buffers();
    c.launches = {make_launch(kernels::xpbd_hub_spring::info(lambda ? "lambda" : "", c.precision),
                              Params{2, n, first_iteration, report}, 1)};
    State state = state_of(in, lambda, first_iteration, report);
    solve_hub(state, in.constraint, 2, n);
    c.expected["delta"] = state.delta_field();
    if (lambda)
        c.expected["multiplier"] = {state.multiplier, state.multiplier_scale};
    c.events = state.events;
    check_on_every_device(c);
}

TEMPLATE_TEST_CASE("the first hub iteration with multipliers moves vertices bitwise as the one without", "",
                   float, double)
{
    using Real = TestType;
    auto in = star<Real>(333, Real(0.5), 777);
    const Precision precision = precision_of<Real>();
    const Params params{2, 333, 1, 1};
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision))
            continue;
        CAPTURE(selector);
        const Buffers a = run(
            *device, {make_launch(kernels::xpbd_hub_spring::info("", precision), params, 1)}, in.buffers());
        const Buffers b =
            run(*device, {make_launch(kernels::xpbd_hub_spring::info("lambda", precision), params, 1)},
                in.buffers());
        CHECK(differing_buffers(a, b) == "");
    }
}
