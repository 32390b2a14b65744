// What the last substep of a world left unsolved, in fp64 on the host.
//
// Based on: Macklin, Mueller, Chentanez. XPBD. Motion in Games 2016. eq. 8 (primal) and eq. 9 (dual).
// Departures: vertices that touch a collider are left out, whose contact forces are on no record.

#include "taut/report/measure_residuals.hpp"

#include "taut/plan/methods.hpp"
#include "taut/report/implicit_residual.hpp"
#include "taut/report/touching.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

using reference::BendingRecord;
using reference::DistanceRecord;
using reference::View;

/// By how much of its length a spring is off.
struct SpringMiss
{
    double of_rest = 0;
    double of_length = 0; ///< that at rest or as the spring should be now, whichever is longer
};

/// Adds J^T lambda to `impulse` (kg m) and gives the dual residual of each distance constraint: eq. 9, with
/// the damper's part of eq. 26, gamma n . (moved_a - moved_b), gamma = damping time / h; over 1 + gamma, so
/// that it is a change of length, by which the ends would have to move.
std::vector<SpringMiss> distance_residuals(const View& view, double h, const std::vector<glm::dvec3>& moved,
                                           std::vector<glm::dvec3>& impulse)
{
    const std::vector<double> lambda = view.world.multipliers("distance");
    std::vector<SpringMiss> out(lambda.size());
    const std::vector<double> times = view.world.damping_times("distance");
    for (std::size_t k = 0; k < lambda.size(); ++k)
    {
        const DistanceRecord& c = view.distance[k];
        const double length = view.length(c);
        if (!(length > 0))
            continue;
        const glm::dvec3 n = (view.x[c.a] - view.x[c.b]) / length;
        impulse[c.a] += n * lambda[k];
        impulse[c.b] -= n * lambda[k];
        if (!(c.rest_length > 0))
            continue;
        const double gamma = times.empty() ? 0 : times[k] / h;
        const double damper = gamma * glm::dot(n, moved[c.a] - moved[c.b]);
        const double open = length - c.rest_length + damper + c.compliance / (h * h) * lambda[k];
        const double missed = open / (1 + gamma);
        out[k] = {std::abs(missed) / c.rest_length,
                  std::abs(missed) / std::max<double>(c.rest_length, length - missed)};
    }
    return out;
}

/// The largest of springs that have flowed, over the yield strain of their body: what is left unsolved flows
/// like what is strained.
double flow_residual(const View& view, const std::vector<SpringMiss>& left)
{
    const auto& bodies = view.world.scene().bodies;
    const std::vector<double> first = view.first_lengths();
    double worst = 0;
    for (std::size_t k = 0; k < left.size(); ++k)
    {
        const DistanceRecord& c = view.distance[k];
        const auto& starts = view.model.body_start;
        const auto next = std::upper_bound(starts.begin(), starts.end(), c.a);
        const double yield =
            bodies[static_cast<std::size_t>(next - starts.begin()) - 1].material.plastic_yield;
        if (yield > 0 && c.rest_length != first[k])
            worst = std::max(worst, left[k].of_rest / yield);
    }
    return worst;
}

double bending_residual(const View& view, double h, std::vector<glm::dvec3>& impulse)
{
    const std::vector<double> lambda = view.world.multipliers("bending");
    if (lambda.empty())
        return 0;
    double worst = 0;
    for (std::size_t k = 0; k < view.bending.size(); ++k)
    {
        const BendingRecord& c = view.bending[k];
        const auto angle = view.angle(c);
        if (!angle.valid)
            continue;
        const std::uint32_t ids[] = {c.edge0, c.edge1, c.wing0, c.wing1};
        for (std::size_t j = 0; j < 4; ++j)
            impulse[ids[j]] +=
                glm::dvec3(angle.gradient[j].x, angle.gradient[j].y, angle.gradient[j].z) * lambda[k];
        const double value = reference::angle_difference(angle.angle, c.rest_angle);
        worst = std::max(worst, std::abs(value + c.compliance / (h * h) * lambda[k]));
    }
    return worst;
}

} // namespace

void measure_residuals(const View& view, StepReport& out)
{
    out.primal_residual = out.dual_residual = -1;
    const auto& sets = view.plan.constraints;
    const bool kept = std::all_of(sets.begin(), sets.end(), [](const ConstraintSet& s) {
        return s.multipliers != kNoBuffer && (s.kind == "distance" || s.kind == "bending");
    });
    // By forces that are on no record.
    const bool limited =
        has_effect(view, "strain_limit") || has_effect(view, "attachment") || has_effect(view, "contact");
    const MethodKind kind = view.world.scene().method.type;
    if ((kind == MethodKind::implicit_euler || kind == MethodKind::vbd) && !limited)
        measure_implicit_residual(view, out);
    // Rest angles of plates are those of the next substep by now.
    const bool by_multipliers = kind == MethodKind::xpbd && kept && view.model.plates.empty();
    if (!by_multipliers || limited)
        return;
    const std::vector<glm::dvec3> moved = view.world.displacements(), guess = view.world.predictions();
    if (guess.empty())
        return;
    const double h = view.plan.timestep / view.plan.substeps;
    std::vector<glm::dvec3> impulse(view.x.size(), glm::dvec3(0));
    const std::vector<SpringMiss> left = distance_residuals(view, h, moved, impulse);
    out.stretch_residual = 0;
    for (const SpringMiss& spring : left)
        out.stretch_residual = std::max(out.stretch_residual, spring.of_length);
    const auto& flows = view.model.flows;
    if (std::find(flows.begin(), flows.end(), true) != flows.end())
        out.flow_residual = flow_residual(view, left);
    out.dual_residual = std::max(out.stretch_residual, bending_residual(view, h, impulse));
    const double gravity = glm::length(view.model.gravity);
    const std::vector<bool> touches = touching_colliders(view.world.scene(), view.world.scene().colliders,
                                                         view.model, view.x, view.world.time());
    double worst = 0;
    for (std::size_t i = 0; i < view.x.size(); ++i)
    {
        if (view.model.pinned[i] || touches[i])
            continue;
        const double mass = view.model.mass[i];
        const glm::dvec3 r = mass * (moved[i] - guess[i]) - impulse[i];
        worst = std::max(worst, glm::length(r) / (mass * (gravity > 0 ? gravity : 1.0) * h * h));
    }
    out.primal_residual = worst;
}

} // namespace taut
