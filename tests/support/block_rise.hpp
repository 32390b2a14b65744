#pragma once
// How a move raises the energy of one vertex of a BlockNet, by the formulas, and the step that may be taken.

#include "support/block_net.hpp"

namespace taut::conformance {

/// With the size of the terms that a kernel adds.
struct Rise
{
    double value = 0, size = 0;

    void add(double v, double s)
    {
        value += v;
        size += s;
    }
};

/// Length of d + step less that of d.
inline double lengthened(const glm::dvec3& d, const glm::dvec3& step)
{
    const double both = glm::length(d) + glm::length(d + step);
    return both > 0 ? glm::dot(step, d + d + step) / both : 0;
}

/// A spring between v and another end, moved by `step` at v; `change`: how much it changed in the substep.
template <typename Real>
Rise spring_rise(const layout::Spring<Real>& s, const glm::dvec3& d, const glm::dvec3& step,
                 const glm::dvec3& change, double inverse_substep, double reach)
{
    const double k = double(s.stiffness), c = double(s.damping) * inverse_substep;
    const double both = glm::length(d) + glm::length(d + step), longer = lengthened(d, step);
    const double stretch = both - 2 * double(s.rest_length), grown = lengthened(d - change, change);
    Rise out;
    out.add(0.5 * k * longer * stretch, k * glm::length(step) * (reach + double(s.rest_length)));
    out.add(c * longer * (grown + 0.5 * longer),
            c * glm::length(step) * (glm::length(change) + glm::length(step) + reach * 1e-7));
    return out;
}

template <typename Real>
Rise hinge_rise(const layout::BendingConstraint<Real>& c, const HingeCorners& now, const HingeCorners& then,
                double reach)
{
    const HingeTerm before = hinge_term(c, now, reach, 0), after = hinge_term(c, then, reach, 0);
    if (!before.shaped || !after.shaped)
        return {};
    const double turn = std::remainder(after.value - before.value, 2 * std::numbers::pi);
    Rise out;
    out.add(0.5 / double(c.compliance) * turn * (2 * before.value + turn),
            1 / double(c.compliance) * (before.value_scale + after.value_scale) *
                (std::abs(before.value) + std::abs(turn) + before.value_scale));
    return out;
}

/// Of the energy of row i's vertex when it moves by `step`.
template <typename Real>
Rise vertex_rise(BlockNet<Real>& net, std::uint32_t i, const glm::dvec3& step, bool hinges, bool damped)
{
    const std::uint32_t v = net.row[4 * i];
    const double inertia = double(net.predicted[v].w);
    const glm::dvec3 lag = glm::dvec3(net.delta[v]) - glm::dvec3(net.predicted[v]);
    Rise out;
    out.add(inertia * (glm::dot(lag, step) + 0.5 * glm::dot(step, step)),
            inertia * glm::length(step) * (glm::length(lag) + glm::length(step)));
    const auto add = [&](const Rise& more) { out.add(more.value, more.size); };
    const auto moved = [&](std::uint32_t u) { return glm::dvec3(net.delta[u]) - glm::dvec3(net.low[u]); };
    for (std::uint32_t k = net.row[4 * i + 1]; k < net.row[4 * i + 5]; ++k)
    {
        layout::Spring<Real> s = net.end[k];
        s.damping = damped ? s.damping : Real(0);
        add(spring_rise(s, net.place(v) - net.place(s.b), step, moved(v) - moved(s.b),
                        std::sqrt(inertia * double(net.position[v].w)), net.size(v) + net.size(s.b)));
    }
    for (std::uint32_t k = net.row[4 * i + 2]; hinges && k < net.row[4 * i + 6]; ++k)
    {
        const auto& c = net.corner[k];
        const std::uint32_t vertex[4] = {c.edge0, c.edge1, c.wing0, c.wing1};
        HingeCorners now, then;
        double size = 0;
        for (std::size_t e = 0; e < 4; ++e)
        {
            now[e] = then[e] = net.place(vertex[e]);
            then[e] += vertex[e] == v ? step : glm::dvec3(0);
            size += net.size(vertex[e]) + glm::length(step);
        }
        add(hinge_rise(c, now, then, size));
    }
    for (std::uint32_t k = net.first_tetrahedron[i]; k < net.first_tetrahedron[i + 1]; ++k)
    {
        const auto [before, size] = tetrahedron_energy(net, net.tetrahedra[k]);
        net.moved = v;
        net.move = step;
        const auto [after, later] = tetrahedron_energy(net, net.tetrahedra[k]);
        net.moved = ~0u;
        out.add(after - before, size + later);
    }
    return out;
}

} // namespace taut::conformance
