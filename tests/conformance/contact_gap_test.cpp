#include "taut/kernels/contact_gap.hpp"

#include "support/contact_net.hpp"

#include <array>
#include <bit>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr double kWayOut = 0.004;

/// What contact_gap must leave of one pair, from its written rules.
struct Gap
{
    glm::dvec3 normal{0}, slip{0}, slipped{0};
    double allowed = 0, value = 0;
    std::array<double, 4> weight{}, nearest{}; ///< of those that act, of all
    bool clear = true; ///< no flag hangs by a rounding
};

/// Four new vertices near each other: a vertex above a triangle, or edges that cross; some anyhow.
template <typename Real>
layout::ContactPair<Real> near_pair(ContactNet<Real>& net, Random& random)
{
    const auto first = static_cast<std::uint32_t>(net.position.size());
    const bool edges = random.chance(0.5);
    const glm::dvec3 centre(random.vec4<double>(1, 0)), u(random.vec4<double>(0.1, 0)),
        v(random.vec4<double>(0.1, 0));
    const glm::dvec3 above = random.uniform(0.1, 0.4) * glm::cross(u, v) / (glm::length(u) + glm::length(v));
    std::array<glm::dvec3, 4> at = {above, u, v, -u - v};
    if (edges)
        at = {above + u, above - u, v, -v};
    for (int k = 0; k < 4; ++k)
    {
        const glm::dvec3 x =
            random.chance(0.1) ? glm::dvec3(random.vec4<double>(0.1, 0)) : at[static_cast<std::size_t>(k)];
        net.position.emplace_back(glm::vec<3, Real>(centre + x), random.inverse_mass<Real>());
        net.delta.push_back(random.vec4<Real>(0.004, Real(0)));
    }
    return {first, first + 1, first + 2, first + 3, edges ? TAUT_CONTACT_EDGES : TAUT_CONTACT_VERTEX};
}

template <typename Real>
Gap gap_of(const ContactNet<Real>& net, const layout::ContactPair<Real>& p,
           const layout::ContactSide<Real>& s, bool first, double ahead)
{
    const bool edges = p.kind == TAUT_CONTACT_EDGES;
    const auto now = nearest_of(p, [&](std::uint32_t v) { return net.x(v) + net.d(v); });
    const glm::dvec3 side(s.normal_x, s.normal_y, s.normal_z);
    const std::uint32_t ids[] = {p.a, p.b, p.c, p.d};
    const bool inside = is_inside(now, 0, edges), through = inside && glm::dot(now.way, side) < 0;
    Gap out;
    out.clear = is_inside(now, 0, edges) == is_inside(now, 1e-3, edges) &&
                std::abs(glm::dot(now.way, side)) > 1e-3 * now.distance();
    const double gap = through ? -now.distance() : now.distance();
    out.normal = now.way / gap;
    double masses = 0;
    const double was[] = {0, static_cast<double>(s.weight_b), static_cast<double>(s.weight_c),
                          static_cast<double>(s.weight_d)};
    glm::dvec3 carried(s.slipped_x, s.slipped_y, s.slipped_z), here(0);
    for (std::size_t k = 0; k < 4; ++k)
    {
        carried += was[k] * (net.x(ids[k]) - net.x(p.a));
        here += now.weight[k] * (net.x(ids[k]) - net.x(p.a));
        out.slip += now.weight[k] * net.d(ids[k]);
        masses += static_cast<double>(net.position[ids[k]].w) * now.weight[k] * now.weight[k];
    }
    const double rest = static_cast<double>(s.rest_gap), before = gap - glm::dot(out.normal, out.slip);
    out.allowed = first ? std::min(rest, before + kWayOut) : static_cast<double>(s.allowed);
    out.value = gap - out.allowed;
    if (first)
    {
        carried = s.sticks > 0 ? carried - out.normal * glm::dot(out.normal, carried) : glm::dvec3(0);
        carried *= std::min(1.0, kWayOut / 64 / std::max(glm::length(carried), 1e-9));
    }
    out.slip += carried;
    out.slipped = carried - here;
    out.nearest = now.weight;
    const bool pushes = !first && ahead > 0;
    out.clear = out.clear && (pushes || std::abs(out.value) > 1e-4);
    const bool acts = (out.value < 0 || pushes) && masses > 0 && (!edges || inside);
    if (acts)
        out.weight = now.weight;
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("contact_gap says how near pairs are, on their own side, and which act", "", float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    using Side = layout::ContactSide<Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool first = GENERATE(true, false);
    CAPTURE(count, first);
    Random random(2800 + count);
    ContactNet<Real> net;
    std::vector<layout::ContactPair<Real>> pairs;
    for (std::uint32_t k = 0; k < count + 2; ++k)
        pairs.push_back(near_pair(net, random));
    std::vector<Side> sides;
    for (const auto& p : pairs)
    {
        // Gaps about as wide as the pairs are apart, so that half of them act.
        const auto now = nearest_of(p, [&](std::uint32_t v) { return net.x(v) + net.d(v); });
        const glm::dvec3 n = random.chance(0.3) ? -now.way / now.distance() : now.way / now.distance();
        const auto gap = static_cast<Real>(now.distance() * random.uniform(0.5, 1.5));
        const auto was = random.vec4<Real>(1, Real(0));
        const glm::dvec3 a = net.x(p.a);
        const glm::dvec3 slipped = glm::dvec3(random.vec4<double>(kWayOut / 64, 0)) - // some carry too much
                                   static_cast<double>(was.x) * (net.x(p.b) - a) -
                                   static_cast<double>(was.y) * (net.x(p.c) - a) -
                                   static_cast<double>(was.z) * (net.x(p.d) - a);
        Side& s = sides.emplace_back();
        s.normal_x = static_cast<Real>(n.x), s.normal_y = static_cast<Real>(n.y);
        s.normal_z = static_cast<Real>(n.z);
        s.allowed = s.rest_gap = gap;
        s.friction = Real(0.4);
        s.slipped_x = static_cast<Real>(slipped.x), s.slipped_y = static_cast<Real>(slipped.y);
        s.slipped_z = static_cast<Real>(slipped.z);
        s.weight_b = was.x, s.weight_c = was.y, s.weight_d = was.z;
        s.sticks = random.chance(0.5) ? Real(1) : Real(0);
    }
    std::vector<Vec> left(2 * (count + 2), Vec(3)); // of the sweep before: w of the second, its push ahead
    for (std::uint32_t k = 0; k < count; ++k)
        left[2 * k + 1].w = random.chance(0.5) ? Real(0) : random.uniform<Real>(0, 1);
    layout::StepValues<Real> step{};
    step.depenetration = static_cast<Real>(kWayOut);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pairs)},
            {"position", bytes_of(net.position)},
            {"delta", bytes_of(net.delta)},
            {"step_values", bytes_of(std::vector{step})},
            {"control", bytes_of(control_of(count))},
            {"side", bytes_of(sides)},
            {"row", bytes_of(left)},
            {"acting", bytes_of(std::vector<std::uint32_t>(net.position.size(), 0))}};
    c.launches = {make_launch(kernels::contact_gap::info("", c.precision),
                              kernels::contact_gap::Params{count + 2, first}, count + 2)};
    std::vector<std::uint32_t> least(net.position.size(), 0), most = least;
    std::size_t acting = 0, crossed = 0;
    for (std::uint32_t k = 0; k < count + 2; ++k)
    {
        Field &side = c.expected["side"], &row = c.expected["row"];
        if (k >= count)
        {
            for (const Real v : std::bit_cast<std::array<Real, 16>>(sides[k]))
                side.add(static_cast<double>(v), 0);
            for (int j = 0; j < 8; ++j)
                row.add(3, 0);
            continue;
        }
        const Gap want = gap_of(net, pairs[k], sides[k], first, static_cast<double>(left[2 * k + 1].w));
        const double blur = want.clear ? 1 + 4 / std::abs(want.value + want.allowed) : kAnyFinite;
        for (int axis = 0; axis < 3; ++axis)
            side.add(want.normal[axis], blur);
        side.add(want.allowed, want.clear ? 4 : kAnyFinite);
        side.add(static_cast<double>(sides[k].rest_gap), 0);
        side.add(static_cast<double>(sides[k].friction), 0);
        for (int unused = 0; unused < 2; ++unused)
            side.add(0, 0);
        for (int axis = 0; axis < 3; ++axis)
            side.add(want.slipped[axis], want.clear ? 200 : kAnyFinite);
        side.add(static_cast<double>(sides[k].sticks), 0);
        for (std::size_t corner = 1; corner < 4; ++corner)
            side.add(want.nearest[corner], want.clear ? 200 : kAnyFinite);
        side.add(0, 0);
        // Weights of triangles of 0.1 m, of a net of metres: some hundred roundings.
        for (const double w : want.weight)
            row.add(w, want.clear ? 200 : kAnyFinite);
        for (int axis = 0; axis < 3; ++axis)
            row.add(want.slip[axis], want.clear ? 8 + blur : kAnyFinite);
        row.add(want.value, want.clear ? 4 : kAnyFinite);
        const std::uint32_t ids[] = {pairs[k].a, pairs[k].b, pairs[k].c, pairs[k].d};
        for (std::size_t j = 0; j < 4; ++j)
        {
            least[ids[j]] += want.clear && std::abs(want.weight[j]) > 1e-3 ? 1 : 0;
            most[ids[j]] += !want.clear || want.weight[j] != 0 ? 1 : 0;
        }
        acting += want.weight[0] != 0 || want.weight[1] != 0 ? 1 : 0;
        crossed += want.value + want.allowed < 0 ? 1 : 0;
    }
    CHECK((count < 1000 || (acting > count / 4 && crossed > count / 20)));
    look_on_every_device(c, [&](const Buffers& out) {
        const auto counts = words_of(out, "acting");
        std::size_t wrong = 0;
        for (std::size_t v = 0; v < counts.size(); ++v)
            wrong += counts[v] < least[v] || counts[v] > most[v] ? 1 : 0;
        CHECK(wrong == 0);
    });
}
