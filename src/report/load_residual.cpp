// What an exact Newton step would still move where a solver ended.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed., 2006, section 3.3 (the Newton step measures
//   the distance to a minimum in the variables; the gradient does so in forces, which say little where
//   directions differ in stiffness). Steihaug. The Conjugate Gradient Method and Trust Regions. SINUM 20,
//   1983, theorem 2.1 (iterates of conjugate gradients grow).
// Departures: taken relative to the motion that the loads alone make, by mass; under methods of one sweep in
//   many small substeps, whose leftovers add up over them, to what the loads move in a long time. A sweep
//   carries a load over one link: where too few are taken, what is left is small beside the springs' own
//   forces, and yet the body hangs in the air. Roundings of stiff springs are large forces that move nothing.

#include "taut/report/load_residual.hpp"

#include "taut/report/static_energy.hpp"
#include "taut/scene/extent.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

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

Eigen::MatrixXd solve(const Matrix& a, const Eigen::MatrixXd& b, bool solids)
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

/// m, of each vertex: the Newton step, and what the loads move along gravity.
struct Steps
{
    std::vector<glm::dvec3> left, loads;
};

Steps newton_steps(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const StaticEnergy energy(model);
    State at;
    for (const glm::dvec3& p : x)
        at.push_back({p.x, p.y, p.z});
    Matrix stiffness = energy.hessian(at, Curvature::projected, 1 / (left.time * left.time));
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(energy.unknowns(), left.against_response ? 2 : 1);
    const glm::dvec3 down = glm::normalize(model.gravity);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
        {
            for (int c = 0; c < 3 && !left.touches[i]; ++c)
            {
                force(u + c, 0) = -left.force[i][c];
                if (left.against_response)
                    force(u + c, 1) = left.load[i] * down[c];
            }
            for (int c = 0; c < 3 && left.touches[i]; ++c)
                stiffness.coeffRef(u + c, u + c) *= kHeld;
        }
    const bool solids = !model.solids.empty() || !model.volumes.empty();
    const Eigen::MatrixXd step = solve(stiffness, force, solids);
    Steps out{std::vector<glm::dvec3>(x.size(), glm::dvec3(0)),
              std::vector<glm::dvec3>(x.size(), glm::dvec3(0))};
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
        {
            out.left[i] = {step(u, 0), step(u + 1, 0), step(u + 2, 0)};
            if (left.against_response)
                out.loads[i] = {step(u, 1), step(u + 1, 1), step(u + 2, 1)};
        }
    return out;
}

/// Of the vertices from `first` to before `last`.
LoadResidual residual_of(const PhysicalModel& model, std::span<const glm::dvec3> x, const Steps& step,
                         const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    const auto begin = left.touches.begin();
    const bool touches = std::find(begin + first, begin + last, true) != begin + last;
    const glm::dvec3 down = glm::normalize(model.gravity);
    double moved = 0, loads = 0, mass = 0, carried = 0;
    for (std::uint32_t i = first; i < last && !left.carried.empty(); ++i)
        carried = std::max(carried, left.carried[i]);
    Extent body;
    for (const glm::dvec3& p : x.subspan(first, last - first))
        body.take(p);
    for (std::uint32_t i = first; i < last; ++i)
        if (!model.pinned[i])
        {
            moved += model.mass[i] * (touches ? kTouching * std::max(0.0, glm::dot(step.left[i], down))
                                              : glm::length(step.left[i]));
            mass += model.mass[i];
            loads += left.against_response ? model.mass[i] * glm::length(step.loads[i])
                                           : left.load[i] * left.time * left.time + model.mass[i] * carried;
        }
    if (!(loads > 0))
        return {};
    const double share = moved / loads, way = moved / (mass * body.size());
    return {std::isfinite(share) ? share : HUGE_VAL, std::isfinite(way) ? way : HUGE_VAL};
}

} // namespace

LoadResidual load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const Steps step = newton_steps(model, x, left);
    LoadResidual worst;
    const auto key = [](const LoadResidual& r) { return std::pair(r.way > kSeenWay, r.share); };
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
    {
        const LoadResidual next =
            residual_of(model, x, step, left, model.body_start[b], model.body_start[b + 1]);
        worst = key(next) > key(worst) ? next : worst;
    }
    return worst;
}

} // namespace taut
