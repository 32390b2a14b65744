// Based on: Hairer, Lubich, Wanner. Geometric Numerical Integration, 2nd ed. 2006, I.1.4 (leapfrog:
//   v(n) = v(n - 1/2) + h/2 a(n)).
// Departures: a(n) is what the last substep showed, so that nothing is evaluated anew, and is limited by the
//   kick that is sure: contacts and stiff constraints act by blows.

#include "taut/world/at_step.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace taut {
namespace {

// Inline: in a loop over all vertices a call of each takes three times as long as what they do.

/// `square`: of the limit. Most are shorter and need no root.
inline glm::dvec3 no_longer_than(const glm::dvec3& v, double square)
{
    const double own = glm::dot(v, v);
    if (own <= square)
        return v;
    return std::isfinite(own) ? v * (std::sqrt(square) / std::sqrt(own)) : glm::dvec3(0);
}

/// What constraints and contacts added to the velocity in the last substep; before the first, nothing.
inline glm::dvec3 borne(const Pace& pace, const Kept& vertex)
{
    return (vertex.displacement - vertex.coasting) / pace.substep;
}

/// What the kept velocity lacks where it stands before the step.
inline glm::dvec3 half_kick(const Pace& pace, const glm::dvec3& shown)
{
    const glm::dvec3 sure = 0.5 * pace.substep * pace.gravity;
    return no_longer_than(sure + 0.5 * shown, glm::dot(sure, sure));
}

/// What the kept velocity has more than the one at the step.
inline glm::dvec3 lead(const Pace& pace, const Kept& vertex)
{
    if (vertex.pull == Pull::held)
        return glm::dvec3(0);
    if (vertex.pull == Pull::gravity)
        return pace.lead * pace.substep * pace.gravity;
    const glm::dvec3 shown = borne(pace, vertex);
    if (pace.lead < 0)
        return -half_kick(pace, shown);
    const glm::dvec3 kick = vertex.velocity - vertex.displacement / pace.substep; // after the displacement
    // Contacts stop what the kick drives against them in the next displacement only.
    if (pace.lead == 0)
        return no_longer_than(-0.5 * shown, glm::dot(kick, kick));
    const glm::dvec3 sure = pace.substep * pace.gravity;
    return no_longer_than(0.5 * (kick - shown), glm::dot(sure, sure));
}

inline glm::dvec3 at_step(const Pace& pace, const Kept& vertex)
{
    return vertex.velocity - lead(pace, vertex);
}

} // namespace

glm::dvec3 velocity_at_step(const Pace& pace, const Kept& vertex) { return at_step(pace, vertex); }

template <typename Real>
std::vector<glm::dvec3> velocities_at_step(const Pace& pace, std::span<const Pull> pull,
                                           std::span<const std::uint32_t> order, std::uint32_t first,
                                           std::span<const glm::vec<4, Real>> velocity,
                                           std::span<const glm::vec<4, Real>> displacement,
                                           std::span<const glm::vec<4, Real>> coasting)
{
    std::vector<glm::dvec3> out(pull.size());
    for (std::size_t v = 0; v < out.size(); ++v)
        out[order[v] - first] = at_step(
            pace, {pull[v], glm::dvec3(velocity[v]), glm::dvec3(displacement[v]), glm::dvec3(coasting[v])});
    return out;
}
template std::vector<glm::dvec3> velocities_at_step<float>(const Pace&, std::span<const Pull>,
                                                           std::span<const std::uint32_t>, std::uint32_t,
                                                           std::span<const glm::vec4>,
                                                           std::span<const glm::vec4>,
                                                           std::span<const glm::vec4>);
template std::vector<glm::dvec3> velocities_at_step<double>(const Pace&, std::span<const Pull>,
                                                            std::span<const std::uint32_t>, std::uint32_t,
                                                            std::span<const glm::dvec4>,
                                                            std::span<const glm::dvec4>,
                                                            std::span<const glm::dvec4>);

Kept repaced(const Pace& before, const Pace& after, const Kept& vertex)
{
    if (before == after || vertex.pull == Pull::held)
        return vertex;
    Kept out = vertex;
    const double h = after.substep, ratio = h / before.substep;
    const glm::dvec3 velocity = velocity_at_step(before, vertex);
    if (vertex.pull == Pull::gravity || after.lead == 0)
    {
        out.velocity = velocity + after.lead * h * after.gravity;
        out.coasting = vertex.displacement;
    }
    else if (after.lead < 0)
    {
        const glm::dvec3 shown = ratio * borne(before, vertex);
        out.velocity = velocity - half_kick(after, shown);
        out.coasting = vertex.displacement - h * shown;
    }
    else
    {
        const bool same = before.gravity == after.gravity && before.lead == after.lead;
        const glm::dvec3 more = same ? ratio * lead(before, vertex) : 0.5 * h * after.gravity;
        out.velocity = velocity + more;
        const glm::dvec3 kick = out.velocity - vertex.displacement / h;
        out.coasting = vertex.displacement - h * (kick - 2.0 * more);
    }
    return out;
}

} // namespace taut
