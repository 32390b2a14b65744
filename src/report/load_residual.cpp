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
constexpr double kHeld = 1e9;     // times the diagonal
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

/// m, of each vertex: the Newton step, and what the loads move along gravity, or along each axis without.
struct Steps
{
    std::vector<glm::dvec3> left;
    std::vector<std::vector<glm::dvec3>> loads;
};

/// Which way loads may pull.
std::vector<glm::dvec3> pulls_of(const PhysicalModel& model)
{
    if (model.gravity == glm::dvec3(0))
        return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    return {glm::normalize(model.gravity)};
}

Steps newton_steps(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const StaticEnergy energy(model);
    State at;
    for (const glm::dvec3& p : x)
        at.push_back({p.x, p.y, p.z});
    Matrix stiffness = energy.hessian(at, Curvature::projected, 1 / (left.time * left.time));
    const std::vector<glm::dvec3> pulls = left.against_response ? pulls_of(model) : std::vector<glm::dvec3>{};
    Eigen::MatrixXd force =
        Eigen::MatrixXd::Zero(energy.unknowns(), 1 + static_cast<Eigen::Index>(pulls.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
        {
            for (int c = 0; c < 3 && !left.touches[i]; ++c)
            {
                force(u + c, 0) = -left.force[i][c];
                for (std::size_t p = 0; p < pulls.size(); ++p)
                    force(u + c, 1 + static_cast<Eigen::Index>(p)) = left.load[i] * pulls[p][c];
            }
            for (int c = 0; c < 3 && left.touches[i]; ++c)
                stiffness.coeffRef(u + c, u + c) *= kHeld;
        }
    const bool solids = !model.solids.empty() || !model.volumes.empty();
    const Eigen::MatrixXd step = solve(stiffness, force, solids);
    const std::vector<glm::dvec3> none(x.size(), glm::dvec3(0));
    Steps out{none, {pulls.size(), none}};
    for (std::size_t i = 0; i < x.size(); ++i)
        if (const int u = energy.unknown(i); u >= 0)
        {
            out.left[i] = {step(u, 0), step(u + 1, 0), step(u + 2, 0)};
            for (std::size_t p = 0; p < pulls.size(); ++p)
            {
                const auto column = 1 + static_cast<Eigen::Index>(p);
                out.loads[p][i] = {step(u, column), step(u + 1, column), step(u + 2, column)};
            }
        }
    return out;
}

/// kg m: what the loads move of the vertices from `first` to before `last`, the way on which that is most.
double largest_response(const PhysicalModel& model, const Steps& step, std::uint32_t first,
                        std::uint32_t last)
{
    double most = 0;
    for (const std::vector<glm::dvec3>& moved : step.loads)
    {
        double sum = 0;
        for (std::uint32_t i = first; i < last; ++i)
            sum += model.pinned[i] ? 0 : model.mass[i] * glm::length(moved[i]);
        most = std::max(most, sum);
    }
    return most;
}

/// Of the vertices from `first` to before `last`.
LoadResidual residual_of(const PhysicalModel& model, std::span<const glm::dvec3> x, const Steps& step,
                         const Leftover& left, std::uint32_t first, std::uint32_t last)
{
    const auto begin = left.touches.begin();
    const bool touches = std::find(begin + first, begin + last, true) != begin + last;
    if (touches && model.gravity == glm::dvec3(0))
        return {}; // no way on which contacts have no part
    const glm::dvec3 down = touches ? glm::normalize(model.gravity) : glm::dvec3(0);
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
            loads += left.load[i] * left.time * left.time + model.mass[i] * carried;
        }
    if (left.against_response)
        loads = largest_response(model, step, first, last);
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
