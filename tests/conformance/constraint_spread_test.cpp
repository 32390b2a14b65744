#include "taut/kernels/constraint_spread.hpp"

#include "support/constraint_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kNoRow = 0xffffffffu;

/// Which springs have a row of their own, and which vertices are visited.
struct Selection
{
    std::vector<std::uint32_t> list, place;
    bool visits(std::uint32_t v) const { return std::find(list.begin() + 1, end(), v) != end(); }
    std::vector<std::uint32_t>::const_iterator end() const { return list.begin() + 1 + list[0]; }
};

/// Rows in another order than springs, two in three springs without; every other vertex.
Selection select(Random& random, std::uint32_t springs, std::uint32_t vertices)
{
    Selection out;
    const auto rows = random.shuffled(springs);
    for (std::uint32_t s = 0; s < springs; ++s)
        out.place.push_back(random.chance(0.33) ? rows[s] : kNoRow);
    out.list.push_back(0);
    for (std::uint32_t v = 0; v < vertices; v += 2, ++out.list[0])
        out.list.push_back(v);
    out.list.resize(vertices + 1, 0); // behind the list anything may stand: 0 is a vertex
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("constraint_spread gathers w J^T x, and the variants apply take it off delta", "", float,
                   double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool apply = GENERATE(false, true), listed = GENERATE(false, true);
    const bool nothing = apply && !listed && GENERATE(false, true);
    CAPTURE(dealt.count, dealt.groups, apply, listed, nothing);
    Random random(50 + dealt.count);
    RowNet<Real> net = random_row_net<Real>(random, 2 * dealt.count); // one vertex more than the count
    REQUIRE(net.vertices() > dealt.count);
    Selection chosen = select(random, net.rows(), dealt.count);
    layout::CgState<Real> state{};
    state.status = nothing ? TAUT_CG_ZERO_RIGHT_HAND_SIDE : TAUT_CG_CONVERGED;

    Case c;
    c.precision = precision_of<Real>();
    const std::vector<typename RowNet<Real>::Vec> before(net.vertices(), {7, 7, 7, 7});
    c.in = {{"start", bytes_of(net.start)},         {"incident", bytes_of(net.incident)},
            {"direction", bytes_of(net.direction)}, {"x", bytes_of(net.p)},
            {"position", bytes_of(net.position)},   {"delta", bytes_of(net.delta)},
            {"spread", bytes_of(before)},           {"state", bytes_of(std::vector{state})},
            {"list", bytes_of(chosen.list)},        {"place", bytes_of(chosen.place)}};
    const std::string variant = listed ? apply ? "listed_apply" : "listed" : apply ? "apply" : "";
    c.launches = {make_launch(kernels::constraint_spread::info(variant, c.precision),
                              kernels::constraint_spread::Params{dealt.count, dealt.chunk()},
                              dealt.dispatched())};
    Field& out = c.expected[apply ? "delta" : "spread"];
    for (std::uint32_t v = 0; v < net.vertices(); ++v)
    {
        const glm::dvec3 old = wide3(apply ? net.delta[v] : before[v]);
        const double w = static_cast<double>(apply ? net.delta[v].w : Real(0));
        if (v >= dealt.count || (listed && !chosen.visits(v)))
        {
            add_vec4(out, old, 0, apply ? w : 7);
            continue;
        }
        glm::dvec3 sum(0);
        double size = 0;
        for (std::uint32_t k = net.start[v]; k < net.start[v + 1]; ++k)
        {
            const std::uint32_t s = net.incident[k] / 2, row = listed ? chosen.place[s] : s;
            if (row == kNoRow)
                continue;
            const double p = static_cast<double>(net.p[row]) * (net.incident[k] % 2 == 0 ? 1 : -1);
            sum += wide3(net.direction[row]) * p;
            size += std::abs(p);
        }
        const double mass = static_cast<double>(net.position[v].w);
        if (apply)
            add_vec4(out, nothing ? old : old - mass * sum, mass * size + glm::length(old), w);
        else
            add_vec4(out, mass * sum, mass * size, 0);
    }
    check_on_every_device(c);
}
