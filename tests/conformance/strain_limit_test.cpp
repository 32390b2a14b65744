#include "taut/kernels/strain_limit.hpp"

#include "support/colours.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
using Constraint = layout::DistanceConstraint<Real>;
template <typename Real>
using Input = Colours<Real, Constraint>;

/// The shared launches give every kernel four parameters; this one has the first two.
struct Params : kernels::strain_limit::Params
{
    Params(std::uint32_t f, std::uint32_t n, std::uint32_t, std::uint32_t)
        : kernels::strain_limit::Params{f, n}
    {}
};

/// A spring beyond its greatest length is brought back to it, by inverse masses; any other is left alone.
template <typename Real>
void shorten(State& s, const Constraint<Real>& c, std::uint32_t)
{
    const double wa = s.position[c.a].w, wb = s.position[c.b].w, most = static_cast<double>(c.rest_length);
    const glm::dvec3 d = s.at(c.a) - s.at(c.b);
    const double length = glm::length(d);
    if (!(length > most) || wa + wb == 0)
        return;
    const double moved = glm::length(glm::dvec3(s.delta[c.a])) + glm::length(glm::dvec3(s.delta[c.b]));
    const double size = length + moved + most + s.delta_scale[c.a] + s.delta_scale[c.b];
    s.push(c.a, d * (wa * (most - length) / (length * (wa + wb))), 2 * size);
    s.push(c.b, d * (-wb * (most - length) / (length * (wa + wb))), 2 * size);
}

/// `count` springs between random disjoint pairs, half of them beyond their greatest length.
template <typename Real>
void add_colour(Input<Real>& in, Random& random, std::uint32_t count, std::uint32_t base,
                std::uint32_t vertices)
{
    const auto order = random.shuffled(vertices);
    for (std::uint32_t i = 0; i < count; ++i)
        in.constraint.push_back(
            {base + order[2 * i], base + order[2 * i + 1], random.uniform<Real>(0.3, 2), Real(0)});
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
    return in;
}

/// Ends in one place, both ends held, one held, a mass ratio of a million; as far as there is room.
template <typename Real>
void plant(Input<Real>& in)
{
    const auto first = in.constraint.begin() + in.colour_start[1];
    if (in.colour_start[2] - in.colour_start[1] < 5)
        return;
    for (const int k : {0, 1})
    {
        auto& b = in.position[first[k].b];
        b = glm::vec<4, Real>(glm::vec<3, Real>(in.position[first[k].a]), b.w);
        in.delta[first[k].b] = in.delta[first[k].a];
    }
    first[1].rest_length = 0;
    const auto masses = [&](int k, Real wa, Real wb) {
        in.position[first[k].a].w = wa;
        in.position[first[k].b].w = wb;
        first[k].rest_length = Real(1e-3);
    };
    masses(2, Real(0), Real(0));
    masses(3, Real(0), Real(3));
    masses(4, Real(1e-6), Real(1));
}

} // namespace

TEMPLATE_TEST_CASE("a strain limit shortens springs beyond it and leaves the others", "[strain_limit]", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint64_t seed = 1300 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const std::uint32_t size = 2 * std::max(count, 5u) + 7;
    auto in = vertices<Real>(random, size);
    for (const std::uint32_t n : {5u, count, 5u}) // the first and the last must not be touched
        add_colour(in, random, n, 0, size);
    in.groups = {{1, 2}};
    plant(in);
    check_colours<Params>(kernels::strain_limit::info, in, Mode(), precision_of<Real>(), shorten<Real>);
}

TEMPLATE_TEST_CASE("strain limits in one group give what one dispatch per colour gives, bit for bit",
                   "[strain_limit]", float, double)
{
    using Real = TestType;
    Random random(1350);
    auto in = vertices<Real>(random, 1000); // few, so that colours share vertices
    for (const std::uint32_t count : {5u, 64u, 1u, 63u, 65u, 200u})
        add_colour(in, random, count, 0, 500);
    for (const std::uint32_t count : {9u, 100u, 3u}) // a second body, a group of its own
        add_colour(in, random, count, 500, 490);
    in.groups = {{1, 6}, {6, 9}};
    plant(in);
    check_tail_equals_dispatches<Params>(kernels::strain_limit::info, in, Mode(), precision_of<Real>());
    Mode mode;
    mode.tail = true;
    check_colours<Params>(kernels::strain_limit::info, in, mode, precision_of<Real>(), shorten<Real>);
}
