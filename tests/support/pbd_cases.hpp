#pragma once
// What the tests of the kernels of position-based dynamics share: random springs, hinges and tetrahedra,
// among them such without a direction, and the correction that each asks for, in fp64.

#include "support/colours.hpp"
#include "support/hinges.hpp"
#include "support/tetrahedra.hpp"

namespace taut::conformance {

template <typename Real>
using Stretch = layout::DistanceConstraint<Real>;
template <typename Real>
using Bend = layout::BendingConstraint<Real>;
template <typename Real>
using Volume = layout::VolumeConstraint<Real>;

/// Vertices and constraints; no two of one kind and colour share a vertex.
template <typename Real>
struct PbdInput
{
    std::vector<glm::vec<4, Real>> position, delta, before; ///< before: the Jacobi iterate two back
    std::vector<Stretch<Real>> spring;
    std::vector<Bend<Real>> hinge;
    std::vector<Volume<Real>> tetrahedron;
    std::vector<std::uint32_t> spring_colours = {0}, hinge_colours = {0}, volume_colours = {0};
};

/// What a constraint asks of its vertices per inverse mass, and how large the terms were that made it.
struct Request
{
    std::array<std::uint32_t, 4> vertex{};
    std::array<glm::dvec3, 4> push{};
    std::array<double, 4> size{};
    std::size_t vertices = 2;
    bool degenerate = false;
};

/// C = |xa - xb| - L: each end goes share * C * w / (wa + wb) along the spring.
template <typename Real>
Request request(const State& s, const Stretch<Real>& c, float share)
{
    Request out;
    out.vertex = {c.a, c.b, 0, 0};
    const double wa = s.position[c.a].w, wb = s.position[c.b].w, rest = static_cast<double>(c.rest_length);
    const glm::dvec3 d = s.at(c.a) - s.at(c.b);
    const double length = glm::length(d);
    out.degenerate = length == 0 && wa + wb > 0 && rest > 0;
    if (length == 0 || wa + wb == 0)
        return out;
    const double k = static_cast<double>(share), scale = (rest - length) * k / (wa + wb);
    const double moved = glm::length(glm::dvec3(s.delta[c.a])) + glm::length(glm::dvec3(s.delta[c.b]));
    const double size = length + moved + s.delta_scale[c.a] + s.delta_scale[c.b];
    for (std::size_t end = 0; end < 2; ++end)
    {
        out.push[end] = d * ((end == 0 ? scale : -scale) / length);
        out.size[end] = (size + rest) * k / (wa + wb) + std::abs(scale) * size / length;
    }
    return out;
}

/// C = theta - theta0: each corner goes -share * C * w grad / (sum of w |grad|^2).
template <typename Real>
Request request(const State& s, const Bend<Real>& c, float share)
{
    Request out;
    out.vertex = {c.edge0, c.edge1, c.wing0, c.wing1};
    out.vertices = 4;
    Corners x;
    double masses = 0, size = 0, inherited = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        x[v] = s.at(out.vertex[v]);
        masses += s.position[out.vertex[v]].w;
        size = std::max(size, glm::length(x[v] - x[0]));
        inherited += s.delta_scale[out.vertex[v]];
    }
    const double thin = std::min(height(x[2], x[0], x[1] - x[0]), height(x[3], x[0], x[1] - x[0]));
    out.degenerate = thin <= 1e-5 * size && masses > 0;
    if (thin <= 1e-5 * size || masses == 0)
        return out;
    const Dual<12> angle = hinge_angle(x);
    double weight = 0, slopes = 0, lightest = 0;
    for (std::size_t i = 0; i < 12; ++i)
    {
        const double w = s.position[out.vertex[i / 3]].w, square = angle.slope[i] * angle.slope[i];
        weight += w * square;
        slopes += square;
        lightest = std::max(lightest, w);
    }
    weight = std::max(weight, lightest * slopes / 64); // corners that move have hardly a part in C
    const double k = static_cast<double>(share);
    const double value = std::remainder(angle.value - static_cast<double>(c.rest_angle), 2 * kPi);
    // A thin triangle turns with the rounding of its corners: that many times more of everything.
    const double shape = (size + inherited) / thin;
    for (std::size_t v = 0; v < 4; ++v)
    {
        const glm::dvec3 g(angle.slope[3 * v], angle.slope[3 * v + 1], angle.slope[3 * v + 2]);
        out.push[v] = g * (-k * value / weight);
        out.size[v] = (kPi * shape * k / weight + k * std::abs(value) / weight * shape) / thin;
    }
    return out;
}

/// C = V - V0: each corner goes -share * C * w g / (sum of w |g|^2), but none further than the longest edge
/// from the first corner.
template <typename Real>
Request request(const State& s, const Volume<Real>& c, float share)
{
    Request out;
    out.vertex = {c.a, c.b, c.c, c.d};
    out.vertices = 4;
    TetrahedronCorners x;
    double masses = 0, size = 0, inherited = 0, reach = 0;
    for (std::size_t v = 0; v < 4; ++v)
    {
        x[v] = s.at(out.vertex[v]);
        masses += s.position[out.vertex[v]].w;
        reach = std::max(reach, glm::length(x[v] - x[0]));
        size = std::max(size, glm::length(x[v] - x[0]) + glm::length(glm::dvec3(s.delta[out.vertex[v]])));
        inherited += s.delta_scale[out.vertex[v]];
    }
    const std::array<glm::dvec3, 4> g = volume_slopes(x);
    double weight = 0, fastest = 0, unsure = 0, slopes = 0, lightest = 0;
    const double turn = size * (size + inherited); // roundings of corners go into products of two edges
    for (std::size_t v = 0; v < 4; ++v)
    {
        const double w = s.position[out.vertex[v]].w, slope = glm::length(g[v]);
        weight += w * slope * slope;
        slopes += slope * slope;
        lightest = std::max(lightest, w);
        unsure += 2 * w * slope * turn;
        fastest = std::max(fastest, w * slope);
    }
    out.degenerate = fastest == 0 && masses > 0;
    if (fastest == 0)
        return out;
    weight = std::max(weight, lightest * slopes / 64); // corners that move have hardly a part in C
    const double k = static_cast<double>(share), rest = static_cast<double>(c.rest_volume);
    const double wanted = (rest - triple(x) / 6) * k / weight;
    const double scale = std::clamp(wanted, -reach / fastest, reach / fastest);
    const double unsure_scale = (turn * size + rest) * k / weight + std::abs(scale) * (1 + unsure / weight);
    for (std::size_t v = 0; v < 4; ++v)
    {
        out.push[v] = g[v] * scale;
        out.size[v] = glm::length(g[v]) * unsure_scale + std::abs(scale) * turn;
    }
    return out;
}

template <typename Real>
State pbd_state(const PbdInput<Real>& in, bool report)
{
    State state;
    for (const auto& p : in.position)
        state.position.emplace_back(p);
    for (const auto& d : in.delta)
        state.delta.emplace_back(d);
    state.delta_scale.assign(in.delta.size(), 0);
    state.report = report;
    return state;
}

/// Gauss-Seidel: what a constraint asks for is done at once.
inline void apply(State& s, const Request& r)
{
    s.events[TAUT_EVENT_DEGENERATE] += s.report && r.degenerate ? 1 : 0;
    for (std::size_t v = 0; v < r.vertices; ++v)
    {
        const double w = s.position[r.vertex[v]].w;
        s.push(r.vertex[v], r.push[v] * w, w * r.size[v]);
    }
}

/// Adds `count` springs between random disjoint pairs of all vertices.
template <typename Real>
void add_spring_colour(PbdInput<Real>& in, Random& random, std::uint32_t count)
{
    const auto order = random.shuffled(static_cast<std::uint32_t>(in.position.size()));
    for (std::uint32_t i = 0; i < count; ++i)
        in.spring.push_back(
            {order[2 * i], order[2 * i + 1], random.uniform<Real>(0.2, 2), random.uniform<Real>(0, 1)});
    in.spring_colours.push_back(static_cast<std::uint32_t>(in.spring.size()));
}

/// Adds `count` hinges with vertices of their own.
template <typename Real>
void add_hinge_colour(PbdInput<Real>& in, Random& random, std::uint32_t count)
{
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
        in.hinge.push_back({base + at[0], base + at[1], base + at[2], base + at[3], static_cast<Real>(rest),
                            random.uniform<Real>(0, 1)});
    }
    in.hinge_colours.push_back(static_cast<std::uint32_t>(in.hinge.size()));
}

/// Adds `count` tetrahedra with vertices of their own, moved from rest by a third of an edge.
template <typename Real>
void add_volume_colour(PbdInput<Real>& in, Random& random, std::uint32_t count)
{
    const auto base = static_cast<std::uint32_t>(in.position.size());
    const auto order = random.shuffled(4 * count);
    in.position.resize(base + 4 * count);
    const auto more = random.vec4s<Real>(4 * count, 1e-2, 0, 1e-3);
    in.delta.insert(in.delta.end(), more.begin(), more.end());
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const TetrahedronCorners rest = random_tetrahedron(random);
        const std::uint32_t* at = &order[4 * i];
        for (std::uint32_t v = 0; v < 4; ++v)
        {
            const glm::dvec3 by(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            in.position[base + at[v]] = with_weight(rest[v] + 0.2 * by, random.inverse_mass<Real>());
        }
        in.tetrahedron.push_back({base + at[0], base + at[1], base + at[2], base + at[3],
                                  static_cast<Real>(triple(rest) / 6), random.uniform<Real>(0, 1)});
    }
    in.volume_colours.push_back(static_cast<std::uint32_t>(in.tetrahedron.size()));
}

template <typename Real>
PbdInput<Real> pbd_vertices(Random& random, std::uint32_t count)
{
    PbdInput<Real> in;
    in.position = random.vec4s<Real>(count, 1, 0, 0);
    for (auto& p : in.position)
        p.w = random.inverse_mass<Real>();
    in.delta = random.vec4s<Real>(count, 1e-2, 0, 1e-3);
    return in;
}

/// Springs that divide by zero if nobody looks, from `first` on, where there is room for them.
template <typename Real>
void plant_springs(PbdInput<Real>& in, std::uint32_t first, std::uint32_t count)
{
    static constexpr struct { double wa, wb; bool same, no_length; } kSpecial[] = {
        {1, 2, true, false},  // no direction: skipped, counted
        {1, 2, true, true},   // already as its rest length wants: not counted
        {0, 0, false, false}, // held ends: not counted
        {0, 0, true, false},  // held and coincident: not counted
        {1, 2, false, true},  // pulls together
        {0, 2, true, false},  // one end free: counted
        {1e-6, 1, false, false}, {0, 3, false, false}};
    for (std::uint32_t i = 0; i < std::size(kSpecial) && std::size(kSpecial) <= count; ++i)
    {
        Stretch<Real>& c = in.spring[first + i];
        auto &a = in.position[c.a], &b = in.position[c.b];
        if (kSpecial[i].same)
        {
            b = a;
            in.delta[c.b] = glm::vec<4, Real>(glm::vec<3, Real>(in.delta[c.a]), in.delta[c.b].w);
        }
        a.w = static_cast<Real>(kSpecial[i].wa);
        b.w = static_cast<Real>(kSpecial[i].wb);
        c.rest_length = kSpecial[i].no_length ? Real(0) : c.rest_length;
    }
}

template <typename Real>
void plant_hinges(PbdInput<Real>& in, std::uint32_t first, std::uint32_t count)
{
    const auto specials = special_hinges();
    for (std::uint32_t i = 0; i < specials.size() && specials.size() <= count; ++i)
    {
        Bend<Real>& c = in.hinge[first + i];
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        for (std::size_t v = 0; v < 4; ++v)
        {
            in.position[vertex[v]] = with_weight(specials[i].x[v], static_cast<Real>(specials[i].w[v]));
            in.delta[vertex[v]] = glm::vec<4, Real>(Real(0));
        }
        c.rest_angle = static_cast<Real>(specials[i].rest);
    }
}

/// Flat, inverted, collapsed and held tetrahedra from `first` on, where there is room for them.
template <typename Real>
void plant_volumes(PbdInput<Real>& in, std::uint32_t first, std::uint32_t count)
{
    const TetrahedronCorners upright = {glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    TetrahedronCorners flat = upright, inverted = upright, line = upright, thin = upright;
    flat[3] = {0.5, 0.5, 0};
    inverted[3] = {0, 0, -1.5};
    line[2] = {2, 0, 0};
    line[3] = {3, 0, 0};
    thin[2] = {0, 0.0078125, 0};
    thin[3] = {0.5, 0, 0.0078125};
    const TetrahedronCorners point = {glm::dvec3(1), glm::dvec3(1), glm::dvec3(1), glm::dvec3(1)};
    const struct { TetrahedronCorners x; std::array<double, 4> w; } kSpecial[] = {
        {flat, {1, 1, 1, 1}},     // has gradients
        {inverted, {1, 2, 3, 4}}, // turned back through flat
        {line, {1, 1, 1, 1}},     // no gradient: counted
        {line, {0, 0, 0, 0}},     // held besides: not counted
        {point, {1, 1, 1, 1}},    // counted
        {thin, {1, 1, 1, 1}},     // would fly 25 m: goes as far as its longest edge
        {thin, {0, 0, 1e6, 1}},
        {upright, {0, 0, 0, 0}},
        {upright, {0, 0, 0, 1e6}}};
    for (std::uint32_t i = 0; i < std::size(kSpecial) && std::size(kSpecial) <= count; ++i)
    {
        const Volume<Real>& c = in.tetrahedron[first + i];
        const std::uint32_t vertex[4] = {c.a, c.b, c.c, c.d};
        for (std::size_t v = 0; v < 4; ++v)
        {
            in.position[vertex[v]] = with_weight(kSpecial[i].x[v], static_cast<Real>(kSpecial[i].w[v]));
            in.delta[vertex[v]] = glm::vec<4, Real>(Real(0));
        }
    }
}

/// The words that the tail variants read: one group for the colours begin..end - 1, after three unused words.
inline std::vector<std::uint32_t> tail_table(const std::vector<std::uint32_t>& colours, std::uint32_t begin,
                                             std::uint32_t end)
{
    std::vector<std::uint32_t> words(kTableFirst, 0xFFFFFFFFu);
    words.insert(words.end(), {kTableFirst + 2 + begin, kTableFirst + 2 + end});
    words.insert(words.end(), colours.begin(), colours.end());
    return words;
}

/// Checks colours begin..end - 1 of a coloured PBD kernel, one dispatch each or in one group; with `slots`
/// the range of constraints at once, which writes corrections.
template <typename Params, typename Real, typename Element>
void check_pbd_colours(KernelTable info, const PbdInput<Real>& in, const std::vector<Element>& elements,
                       const std::vector<std::uint32_t>& colours, std::uint32_t begin, std::uint32_t end,
                       std::string_view variant, float share, bool report)
{
    constexpr std::size_t corners = std::is_same_v<Element, Stretch<Real>> ? 2 : 4;
    constexpr std::size_t slots = corners == 2 ? 1 : 4;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(elements)},
            {"position", bytes_of(in.position)},
            {"delta", bytes_of(in.delta)},
            {"events", no_events()},
            {"table", bytes_of(tail_table(colours, begin, end))},
            {"correction", bytes_of(std::vector<glm::vec<4, Real>>(slots * elements.size()))}};
    const KernelInfo& kernel = info(variant, c.precision);
    const auto range = [&](std::uint32_t from, std::uint32_t to) {
        c.launches.push_back(make_launch(kernel, Params{from, to - from, share, report}, to - from));
    };
    if (variant == "tail") // two groups too many, as a folded dispatch has: they must do nothing
        c.launches = {make_launch(kernel, Params{kTableFirst, 1, share, report}, 3)};
    else if (variant == "slots")
        range(colours[begin], colours[end]);
    else
        for (std::uint32_t colour = begin; colour < end; ++colour)
            range(colours[colour], colours[colour + 1]);
    State state = pbd_state(in, report);
    Field correction;
    for (std::uint32_t k = 0; k < elements.size(); ++k)
    {
        const bool mine = k >= colours[begin] && k < colours[end];
        const Request r = mine ? request(state, elements[k], share) : Request{};
        if (mine && variant != "slots")
            apply(state, r);
        else
            state.events[TAUT_EVENT_DEGENERATE] += report && r.degenerate ? 1 : 0;
        for (std::size_t slot = 0; slot < slots; ++slot)
            for (int axis = 0; axis < 4; ++axis)
                correction.add(axis < 3 ? r.push[slot][axis] : 0, axis < 3 ? r.size[slot] : 0);
    }
    if (variant == "slots")
        c.expected["correction"] = correction;
    else
        c.expected["delta"] = state.delta_field();
    c.events = state.events;
    check_on_every_device(c);
}

} // namespace taut::conformance
