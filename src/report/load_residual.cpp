// What an exact Newton step would still move where a solver ended.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed., 2006, section 3.3 (the Newton step measures
//   the distance to a minimum in the variables; the gradient does so in forces, which say little where
//   directions differ in stiffness). Steihaug. The Conjugate Gradient Method and Trust Regions. SINUM 20,
//   1983, theorem 2.1 (iterates of conjugate gradients grow).
// Departures: taken relative to the motion that the loads alone make, by mass. A sweep carries a load over
//   one link: where too few are taken, what is left is small beside the springs' own forces, and yet the body
//   hangs in the air. Roundings of stiff springs are large forces that move nothing.

#include "taut/report/load_residual.hpp"

#include "taut/report/static_energy.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace taut {
namespace {

using reference::Curvature;
using reference::State;
using reference::StaticEnergy;
using Matrix = Eigen::SparseMatrix<double>; // the lower triangle

constexpr int kMostFactored = 30000, kMostFactoredOfSolids = 6000; // unknowns; solids fill more
constexpr int kMostIterations = 1000;
constexpr double kHeld = 1e9;    // times the diagonal
constexpr double kTouching = 0.5; // right runs leave more where vertices are held that a contact may let go

Eigen::VectorXd solve(const Matrix& a, const Eigen::VectorXd& b, bool solids)
{
    if (a.rows() <= (solids ? kMostFactoredOfSolids : kMostFactored))
    {
        const Eigen::SimplicialLDLT<Matrix> factors(a);
        if (factors.info() == Eigen::Success)
            return factors.solve(b);
    }
    Eigen::ConjugateGradient<Matrix, Eigen::Lower> gradients(a);
    gradients.setTolerance(1e-3);
    gradients.setMaxIterations(kMostIterations);
    return gradients.solve(b);
}

/// m, the Newton step of each vertex.
std::vector<glm::dvec3> newton_step(const PhysicalModel& model, std::span<const glm::dvec3> x,
                                    const Leftover& left)
{
    const StaticEnergy energy(model);
    State at;
    for (const glm::dvec3& p : x)
        at.push_back({p.x, p.y, p.z});
    Matrix stiffness = energy.hessian(at, Curvature::projected, 1 / (left.substep * left.substep));
    Eigen::VectorXd force = Eigen::VectorXd::Zero(energy.unknowns());
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
        {
            if (!left.touches[i])
                force.segment<3>(u) << -left.force[i].x, -left.force[i].y, -left.force[i].z;
            for (int c = 0; c < 3 && left.touches[i]; ++c)
                stiffness.coeffRef(u + c, u + c) *= kHeld;
        }
    const bool solids = !model.solids.empty() || !model.volumes.empty();
    const Eigen::VectorXd step = solve(stiffness, force, solids);
    std::vector<glm::dvec3> out(x.size(), glm::dvec3(0));
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
            out[i] = {step[u], step[u + 1], step[u + 2]};
    return out;
}

/// Of the vertices from `first` to before `last`.
double residual_of(const PhysicalModel& model, std::span<const glm::dvec3> step, const Leftover& left,
                   std::uint32_t first, std::uint32_t last)
{
    const auto begin = left.touches.begin();
    const bool touches = std::find(begin + first, begin + last, true) != begin + last;
    const glm::dvec3 down = glm::normalize(model.gravity);
    double moved = 0, loads = 0;
    for (std::uint32_t i = first; i < last; ++i)
        if (!model.pinned[i])
        {
            moved += model.mass[i] * (touches ? kTouching * std::max(0.0, glm::dot(step[i], down))
                                              : glm::length(step[i]));
            loads += left.load[i];
        }
    const double share = moved / (loads * left.substep * left.substep);
    return loads > 0 ? (std::isfinite(share) ? share : HUGE_VAL) : -1;
}

} // namespace

double load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const std::vector<glm::dvec3> step = newton_step(model, x, left);
    double worst = -1;
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
        worst = std::max(worst, residual_of(model, step, left, model.body_start[b], model.body_start[b + 1]));
    return worst;
}

} // namespace taut
