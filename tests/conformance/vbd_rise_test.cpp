#include "taut/kernels/vbd_rise.hpp"

#include "support/block_parts.hpp"
#include "support/block_rise.hpp"
#include "support/vbd_carrier.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// The net with every vertex that moves where its body stood: shapes of the fallback.
template <typename Real>
BlockNet<Real> fallback_of(BlockNet<Real> net)
{
    for (std::size_t v = 0; v < net.delta.size(); ++v)
        if (net.position[v].w > 0)
            net.delta[v] = net.low[v];
    return net;
}

template <typename Real>
bool leads(const BlockNet<Real>& net, std::uint32_t v, std::uint32_t other)
{
    return v < other || net.held(other);
}

/// What row i adds for the shapes of its elements.
template <typename Real>
Rise elements_rise(const BlockNet<Real>& net, const BlockNet<Real>& still, std::uint32_t i, bool hinges)
{
    const std::uint32_t v = net.row[4 * i];
    const double per_substep = std::sqrt(double(net.predicted[v].w) * double(net.position[v].w));
    Rise out;
    const auto add = [&](const Rise& more) { out.add(more.value, more.size); };
    const auto moved = [&](std::uint32_t u) { return glm::dvec3(still.delta[u]) - glm::dvec3(net.low[u]); };
    for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
    {
        const auto& s = net.end[k];
        if (!leads(net, v, s.b))
            continue;
        const glm::dvec3 d = still.place(v) - still.place(s.b), then = net.place(v) - net.place(s.b);
        const glm::dvec3 came = moved(v) - moved(s.b); // held ends, since before the substep
        Rise rise = spring_rise(s, d, then - d, came, per_substep, net.size(v) + net.size(s.b));
        const double way = glm::length(glm::dvec3(net.delta[v])) + glm::length(glm::dvec3(net.delta[s.b]));
        rise.size += (double(s.stiffness) + double(s.damping) * per_substep) * way *
                     (net.size(v) + net.size(s.b) + double(s.rest_length));
        add(rise);
    }
    for (std::uint32_t k = net.row[4 * i + 2]; hinges && k < net.row[4 * i + 6]; ++k)
    {
        const auto& c = net.corner[k];
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        HingeCorners now, then;
        double size = 0;
        std::size_t first = 4;
        for (std::size_t e = 0; e < 4; ++e)
        {
            now[e] = still.place(vertex[e]);
            then[e] = net.place(vertex[e]);
            size += net.size(vertex[e]) + still.size(vertex[e]);
            first = first == 4 && !net.held(vertex[e]) ? e : first;
        }
        if (vertex[first] == v)
            add(hinge_rise(c, now, then, size));
    }
    for (std::uint32_t k = net.first_tetrahedron[i]; k < net.first_tetrahedron[i + 1]; ++k)
    {
        const auto& t = net.tetrahedra[k].solid;
        if (!(leads(net, v, t.a) && leads(net, v, t.c) && leads(net, v, t.d)))
            continue;
        const auto [before, size] = tetrahedron_energy(still, net.tetrahedra[k]);
        const auto [after, later] = tetrahedron_energy(net, net.tetrahedra[k]);
        add({after - before, size + later});
    }
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("vbd_rise sums by how much displacements raise a body's energy", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::string variant = GENERATE("", "hinges", "volumes", "elastic");
    const std::uint32_t ended = GENERATE(0u, 1u);
    const bool framed = GENERATE(false, true);
    CAPTURE(count, variant, ended, framed);
    Random random(1400 + count);
    const Solids solids = variant == "volumes"   ? Solids::volumes
                          : variant == "elastic" ? Solids::elastic
                                                 : Solids::none;
    const Kinds kinds = {variant != "", true, solids};
    const auto net = block_net<Real>(random, count, kinds.hinges, kinds.solids);
    const auto still = fallback_of(net);
    const BodyParts parts = deal_parts(count);
    const auto row = rows_of(net, kinds);
    const glm::vec<3, Real> fall(Real(1e-3), Real(-3e-3), Real(2e-4));
    Case c;
    c.precision = precision_of<Real>();
    c.in = buffers_of(net, kinds);
    c.in["row"] = bytes_of(parts.behind(row));
    std::vector<Real> sums(parts.groups * TAUT_VBD_PARTS, Real(7));
    sums.insert(sums.end(), {fall.x, fall.y, fall.z, Real(7), Real(7)});
    const std::uint32_t frame = framed ? static_cast<std::uint32_t>(sums.size()) : 0;
    const std::vector<Carrier> carriers = add_frames(sums, parts, random);
    c.in["sums"] = bytes_of(sums);
    const kernels::vbd_rise::Params params{parts.groups, ended, static_cast<std::uint32_t>(row.size()),
                                           frame};
    c.launches = {make_launch(kernels::vbd_rise::info(variant, c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    const auto way_of = [&](const auto& places, std::uint32_t v) {
        return glm::dvec3(places[v]) - glm::dvec3(net.low[v]);
    };
    const glm::dvec3 taken = ended != 0 ? glm::dvec3(fall) : glm::dvec3(0);
    for (const BodyParts::Part& part : parts.parts)
    {
        const Carrier& carrier = carriers[part.from];
        const bool carried = framed && carrier.carries, loose = !part.held && !carried;
        const std::uint32_t base = net.row[4 * part.base];
        const glm::dvec3 origin = way_of(net.delta, base), none(0), base_way = loose ? origin : none;
        const glm::dvec3 base_came = loose && ended != 0 ? way_of(net.predicted, base) - taken : base_way;
        double value[10] = {}, size[10] = {};
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t i = parts.order[j], v = net.row[4 * i];
            const double inertia = double(net.predicted[v].w);
            const double apart = glm::length(net.before(v)) + glm::length(net.before(base));
            const glm::dvec3 frame_way = carried ? carrier.way_at(net.before(v) - net.before(base)) : none;
            const glm::dvec3 moved = way_of(net.delta, v) - base_way - frame_way,
                             guess = way_of(net.predicted, v) - taken - base_came - frame_way,
                             ahead = glm::dvec3(net.delta[v]) - glm::dvec3(net.predicted[v]);
            const double far = glm::length(glm::dvec3(net.delta[v])) + glm::length(base_way) +
                               glm::length(glm::dvec3(net.predicted[v])) + glm::length(base_came) +
                               glm::length(taken) + (carried ? carrier.size(apart) : 0);
            const Rise rise = elements_rise(net, still, i, kinds.hinges);
            // Gravity does no work on what is seen from the body's own first row.
            const double own = ended == 0 ? 0.5 * (glm::dot(ahead, ahead) - glm::dot(guess, guess))
                               : loose    ? 0
                                          : -glm::dot(glm::dvec3(fall), moved);
            value[0] += inertia * own + rise.value;
            size[0] += inertia * far * far + rise.size;
            value[1] += inertia;
            size[1] += inertia;
            value[8] += inertia * glm::dot(moved, moved);
            value[9] += inertia * glm::dot(guess, guess);
            size[8] += inertia * far * far;
            size[9] += inertia * far * far;
            for (int k = 0; k < 3; ++k)
            {
                value[2 + k] += inertia * moved[k];
                value[5 + k] += inertia * guess[k];
                size[2 + k] += inertia * far;
                size[5 + k] += inertia * far;
            }
        }
        for (int k = 0; k < 10; ++k)
            field.add(value[k], size[k]);
        for (int k = 0; k < 3; ++k)
            field.add(origin[k], glm::length(glm::dvec3(net.delta[base])));
    }
    for (std::size_t k = field.value.size(); k < sums.size(); ++k)
        field.add(double(sums[k]), 0);
    check_on_every_device(c);
}
