#include "taut/kernels/xpbd_volume.hpp"

#include "support/tetrahedra.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::xpbd_volume::Params;

namespace {

template <typename Real>
using Constraint = layout::VolumeConstraint<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;

/// XPBD by definition: C = V - V0, gradients a sixth of the cross products of the edges opposite.
template <typename Real>
void project(State& s, const Constraint<Real>& c, std::uint32_t k)
{
    const std::uint32_t vertex[4] = {c.a, c.b, c.c, c.d};
    TetrahedronCorners x;
    double masses = 0, size = 0, inherited = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        x[v] = s.at(vertex[v]);
        masses += s.position[vertex[v]].w;
        size = std::max(size, glm::length(x[v] - x[0]) + glm::length(glm::dvec3(s.delta[vertex[v]])));
        inherited += s.delta_scale[vertex[v]];
    }
    const glm::dvec3 a = x[1] - x[0], b = x[2] - x[0], d = x[3] - x[0];
    const glm::dvec3 g[4] = {-(glm::cross(b, d) + glm::cross(d, a) + glm::cross(a, b)) / 6.0,
                             glm::cross(b, d) / 6.0, glm::cross(d, a) / 6.0, glm::cross(a, b) / 6.0};
    double weight = 0, steepest = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        weight += s.position[vertex[v]].w * glm::dot(g[v], g[v]);
        steepest = std::max(steepest, glm::length(g[v]));
    }
    const double before = s.lambda && !s.first_iteration ? s.multiplier[k] : 0;
    if (s.lambda)
        s.multiplier[k] = before;
    if (weight == 0)
    {
        s.events[TAUT_EVENT_DEGENERATE] += s.report && masses > 0 ? 1 : 0;
        return;
    }
    const double soft = static_cast<double>(c.compliance) * s.inverse_substep * s.inverse_substep;
    const double volume = triple(x) / 6, rest = static_cast<double>(c.rest_volume);
    const double dlambda = -(volume - rest + soft * before) / (weight + soft);
    // Roundings of the corners go into every product of two or three edges.
    const double turn = size * (size + inherited);
    const double terms = (turn * size + rest + soft * std::abs(before)) / (weight + soft);
    const double weigh = std::abs(dlambda) * turn / std::max(steepest, 1e-300);
    for (std::size_t v = 0; v < 4; ++v)
    {
        const double w = s.position[vertex[v]].w;
        s.push(vertex[v], g[v] * (w * dlambda),
               w * (steepest * (terms + weigh) + std::abs(dlambda) * turn));
    }
    if (s.lambda)
    {
        s.multiplier[k] = before + dlambda;
        s.multiplier_scale[k] = std::abs(before) + terms + weigh;
    }
}

constexpr double kCompliances[] = {0, 1e-9, 1e-6, 1e-3};

template <typename Real>
void add(Input<Real>& in, Random& random, std::uint32_t count)
{
    add_tetrahedra(in, random, count, 1, [&](const auto& v, const TetrahedronCorners& rest) {
        return Constraint<Real>{v[0], v[1], v[2], v[3], static_cast<Real>(triple(rest) / 6),
                                static_cast<Real>(kCompliances[random.below(4)])};
    });
}

/// Flat, inverted, collapsed and held ones, where the colour has room.
template <typename Real>
void plant(Input<Real>& in, std::uint32_t colour)
{
    const std::uint32_t k = in.colour_start[colour];
    if (in.colour_start[colour + 1] - k < 6)
        return;
    const TetrahedronCorners upright = {glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    TetrahedronCorners flat = upright, inverted = upright, line = upright;
    flat[3] = {0.5, 0.5, 0};
    inverted[3] = {0, 0, -1.5};
    line[2] = {2, 0, 0};
    line[3] = {3, 0, 0};
    place(in, k, flat, {1, 1, 1, 1});         // has gradients
    place(in, k + 1, inverted, {1, 2, 3, 4}); // turned back through flat
    place(in, k + 2, line, {1, 1, 1, 1});     // no gradient: counted
    place(in, k + 3, line, {0, 0, 0, 0});     // held besides: not counted
    place(in, k + 4, upright, {0, 0, 0, 0});
    place(in, k + 5, upright, {0, 0, 0, 1e6});
}

} // namespace

TEMPLATE_TEST_CASE("a volume constraint moves all corners by the XPBD formula", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    Mode mode;
    mode.lambda = GENERATE(false, true);
    mode.first_iteration = GENERATE(true, false);
    mode.report = GENERATE(true, false);
    CAPTURE(count, mode.variant(), mode.first_iteration, mode.report);
    Random random(1300 + count);
    Input<Real> in;
    for (const std::uint32_t n : {5u, count, 5u})
        add(in, random, n);
    in.groups = {{1, 2}};
    plant(in, 1);
    check_colours<Params>(kernels::xpbd_volume::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("the tail of a colouring gives what one volume dispatch per colour gives, bit for bit", "",
                   float, double)
{
    using Real = TestType;
    Mode mode;
    mode.lambda = GENERATE(false, true);
    Random random(1350);
    Input<Real> in;
    for (const std::uint32_t count : {5u, 64u, 1u, 65u})
        add(in, random, count);
    in.groups = {{1, 3}, {3, 4}};
    plant(in, 1);
    check_tail_equals_dispatches<Params>(kernels::xpbd_volume::info, in, mode, precision_of<Real>());
    mode.tail = true;
    check_colours<Params>(kernels::xpbd_volume::info, in, mode, precision_of<Real>(), project<Real>);
}

TEMPLATE_TEST_CASE("the first volume iteration with multipliers moves vertices bitwise as the one without",
                   "", float, double)
{
    using Real = TestType;
    Random random(1360);
    Input<Real> in;
    add(in, random, 1000);
    in.groups = {{0, 1}};
    plant(in, 0);
    check_first_iteration_equals_base<Params>(kernels::xpbd_volume::info, in, precision_of<Real>());
}
