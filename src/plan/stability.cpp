// Based on: Gershgorin's circles for M^-1 K; Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006,
//   I.5 (symplectic Euler is stable for h omega < 2).
// Departures: with dampers taken at the old velocity. A mode of stiffness k and damping c (per mass) is
// stepped by
//   z^2 - (2 - h^2 k - h c) z + (1 - h c) = 0, whose roots lie inside the unit circle when h^2 k + 2 h c < 4
//   (Jury). Velocity Verlet asks for h^2 k (1 + a) < 4 (1 + a^2) with a = 1 - h c / 2, which follows from it.
#include "taut/plan/stability.hpp"

#include "taut/plan/added_elements.hpp"
#include "taut/plan/added_stiffness.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/held.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut {
std::array<double, 4> hinge_gradient_sizes(const BendElement& h, std::span<const glm::dvec3> x)
{
    const glm::dvec3 e = x[h.edge1] - x[h.edge0], a = x[h.wing0] - x[h.edge0], b = x[h.wing1] - x[h.edge0];
    const glm::dvec3 n1 = glm::cross(e, a), n2 = glm::cross(b, e);
    const double ee = glm::dot(e, e), area1 = glm::dot(n1, n1), area2 = glm::dot(n2, n2);
    if (!(ee > 0) || !(area1 > 0) || !(area2 > 0))
        return {};
    const glm::dvec3 g2 = n1 * (-std::sqrt(ee) / area1), g3 = n2 * (-std::sqrt(ee) / area2);
    const double s2 = glm::dot(a, e) / ee, s3 = glm::dot(b, e) / ee;
    return {glm::length(g2 * (s2 - 1) + g3 * (s3 - 1)), glm::length(g2 * s2 + g3 * s3), glm::length(g2),
            glm::length(g3)};
}

bool acts_as_force(const Scene& scene, const StretchElement& spring)
{
    return scene.method.type != MethodKind::implicit_constraints ||
           !(scene.method.constrained == ConstrainedSprings::all || spring.kind == SpringKind::structural);
}

std::vector<double> stiffness_rows(const std::vector<StretchElement>& springs,
                                   const std::vector<BendElement>& hinges, std::size_t vertices,
                                   std::span<const glm::dvec3> x)
{
    std::vector<double> stiff(vertices, 0.0);
    for (const StretchElement& s : springs)
        for (const std::uint32_t v : {s.a, s.b})
            stiff[v] += 2 / s.compliance;
    for (const BendElement& h : hinges)
    {
        const std::array<double, 4> size = hinge_gradient_sizes(h, x);
        const double sum = size[0] + size[1] + size[2] + size[3];
        const std::uint32_t vertex[4] = {h.edge0, h.edge1, h.wing0, h.wing1};
        for (std::size_t c = 0; c < 4; ++c)
            if (sum > 0)
                stiff[vertex[c]] += size[c] * sum / h.compliance;
    }
    return stiff;
}

RateBounds rate_bounds(const std::vector<StretchElement>& springs, const std::vector<BendElement>& hinges,
                       const std::vector<double>& mass, const std::vector<bool>& held,
                       std::span<const glm::dvec3> x, std::span<const double> more)
{
    std::vector<double> stiff = stiffness_rows(springs, hinges, mass.size(), x);
    for (std::size_t v = 0; v < more.size(); ++v)
        stiff[v] += more[v];
    std::vector<double> damp(mass.size(), 0.0);
    for (const StretchElement& s : springs)
        for (const std::uint32_t v : {s.a, s.b})
            damp[v] += 2 * s.damping;
    RateBounds out;
    for (std::size_t v = 0; v < mass.size(); ++v)
        if (!held[v])
        {
            out.stiffness = std::max(out.stiffness, stiff[v] / mass[v]);
            out.damping = std::max(out.damping, damp[v] / mass[v]);
        }
    return out;
}

RateBounds rate_bounds(const Scene& resolved)
{
    RateBounds out;
    for (const Body& body : resolved.bodies)
    {
        auto springs = stretch_elements(body);
        std::erase_if(springs, [&](const StretchElement& e) { return !acts_as_force(resolved, e); });
        const auto hinges = resolved.method.type == MethodKind::implicit_constraints
                                ? std::vector<BendElement>()
                                : bend_elements(body); // rows there
        const auto mass = vertex_masses(body);
        const auto held = held_vertices(body);
        for (const auto* x : {&body.mesh.positions, &body.start_positions})
        {
            if (x->empty())
                continue;
            const RateBounds own =
                rate_bounds(springs, hinges, mass, held, *x, added_stiffness_rows(body, *x));
            out.stiffness = std::max(out.stiffness, own.stiffness);
            out.damping = std::max(out.damping, own.damping);
        }
    }
    return out;
}

double stable_step(const RateBounds& rates)
{
    const double root = std::sqrt(rates.damping * rates.damping + 4 * rates.stiffness);
    const double sum = rates.damping + root;
    return sum > 0 ? 4 / sum : std::numeric_limits<double>::infinity();
}

Substeps stable_substeps(const Scene& scene)
{
    Refusals refused; // what of added elements has no stiffness to take account of
    check_added_elements(scene, refused);
    refused.throw_first();
    const MethodSettings& method = scene.method;
    const std::uint32_t asked = method.substeps == 0 ? automatic_substeps(scene) : method.substeps;
    if (method.stability == StabilityRule::ignore)
        return {asked, 0};
    const double largest = kStableShare * stable_step(rate_bounds(scene));
    const double needed = std::max(std::ceil(scene.timestep / largest), 1.0);
    const bool stable = needed <= asked;
    const double allowed = std::isfinite(largest) ? largest : 0;
    if (stable)
        return {asked, allowed};
    if (method.stability == StabilityRule::substep && needed <= kMostSubsteps)
        return {static_cast<std::uint32_t>(needed), allowed};
    const std::string way_out =
        needed > kMostSubsteps
            ? ", more than the " + std::to_string(kMostSubsteps) +
                  " there may be; use an implicit or position-based method, or softer springs"
            : "; set method.substeps to that, or method.stability to \"substep\"";
    throw Error(ErrorCode::unstable_timestep,
                "method.substeps is " + std::to_string(asked) + ", so a substep " +
                    shown(scene.timestep / asked, 4) + " s, and the longest stable one of method " +
                    quoted(method.type) + " " + shown(largest, 4) + " s (" + shown(kStableShare) +
                    " of what the stiffest vertex allows); it takes " + shown(needed) + " substeps" +
                    way_out);
}

} // namespace taut
