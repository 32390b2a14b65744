// What an exact Newton step would still move where a solver ended.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed., 2006, section 3.3 (the Newton step measures the
//   distance to a minimum in the variables; the gradient does so in forces, which say little where directions
//   differ in stiffness). Steihaug. The Conjugate Gradient Method and Trust Regions. SINUM 20, 1983, theorem
//   2.1 (iterates of conjugate gradients grow).
// Departures: taken relative to the motion that the loads alone make, by mass. A sweep carries a load over one
//   link: where too few are taken, what is left is small beside the springs' own forces, and yet the body
//   hangs in the air. Roundings of stiff springs are large forces that move nothing.

#include "taut/report/load_residual.hpp"

#include "taut/report/static_energy.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

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

constexpr int kMostFactored = 30000; // unknowns; solids of more fill gigabytes
constexpr int kMostIterations = 1000;

Eigen::VectorXd solve(const Matrix& a, const Eigen::VectorXd& b)
{
    if (a.rows() <= kMostFactored)
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

/// m, what the Newton step moves each vertex; none where a number is not finite.
std::vector<double> newton_step(const PhysicalModel& model, std::span<const glm::dvec3> x,
                                const Leftover& left)
{
    const StaticEnergy energy(model);
    State at;
    for (const glm::dvec3& p : x)
        at.push_back({p.x, p.y, p.z});
    Eigen::VectorXd force(energy.unknowns());
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
            force.segment<3>(u) << left.force[i].x, left.force[i].y, left.force[i].z;
    const Eigen::VectorXd step =
        solve(energy.hessian(at, Curvature::projected, 1 / (left.substep * left.substep)), force);
    if (!step.allFinite())
        return {};
    std::vector<double> out(x.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
            out[i] = step.segment<3>(u).norm();
    return out;
}

/// A contact moves its vertices after they were solved, so what is left beside them is its own.
bool judged(const PhysicalModel& model, const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    bool moves = false;
    for (std::uint32_t i = first; i < last; ++i)
    {
        if (!model.pinned[i] && left.touches[i])
            return false;
        moves = moves || !model.pinned[i];
    }
    return moves;
}

} // namespace

double load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    std::vector<double> step;
    double worst = -1;
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
    {
        const std::uint32_t first = model.body_start[b], last = model.body_start[b + 1];
        if (!judged(model, left, first, last))
            continue;
        if (step.empty()) // of all bodies at once, if one is judged at all
            step = newton_step(model, x, left);
        if (step.empty())
            return -1;
        double moved = 0, loads = 0;
        for (std::uint32_t i = first; i < last; ++i)
            if (!model.pinned[i])
            {
                moved += model.mass[i] * step[i];
                loads += left.load[i];
            }
        worst = std::max(worst, loads > 0 ? moved / (loads * left.substep * left.substep) : 0);
    }
    return worst;
}

} // namespace taut
