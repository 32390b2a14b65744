// Based on: Hairer, Lubich, Wanner. Geometric Numerical Integration, 2nd ed. 2006, I.1.4 (leapfrog:
//   v(n) = v(n - 1/2) + h/2 a(n)).
// Departures: a(n) is what the last substep showed, so that nothing is evaluated anew, and is limited by the
//   kick that is sure: contacts and stiff constraints act by blows.

#include "taut/world/at_step.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace taut {
namespace {

glm::dvec3 no_longer_than(const glm::dvec3& v, double limit)
{
    const double length = glm::length(v);
    if (length <= limit)
        return v;
    return std::isfinite(length) ? v * (limit / length) : glm::dvec3(0);
}

/// What constraints and contacts added to the velocity in the last substep; before the first, nothing.
glm::dvec3 borne(const Pace& pace, const Kept& vertex)
{
    return (vertex.displacement - vertex.coasting) / pace.substep;
}

/// What the kept velocity lacks where it stands before the step.
glm::dvec3 half_kick(const Pace& pace, const glm::dvec3& shown)
{
    const glm::dvec3 sure = 0.5 * pace.substep * pace.gravity;
    return no_longer_than(sure + 0.5 * shown, glm::length(sure));
}

/// What the kept velocity has more than the one at the step.
glm::dvec3 lead(const Pace& pace, const Kept& vertex)
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
        return no_longer_than(-0.5 * shown, glm::length(kick));
    return no_longer_than(0.5 * (kick - shown), pace.substep * glm::length(pace.gravity));
}

} // namespace

glm::dvec3 velocity_at_step(const Pace& pace, const Kept& vertex)
{
    return vertex.velocity - lead(pace, vertex);
}

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
