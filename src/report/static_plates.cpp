// Based on: Arnold, Brezzi. Mixed and Nonconforming Finite Element Methods. RAIRO M2AN 19, 1985 (moments as
//   unknowns beside displacements); Vanderbei. Symmetric Quasidefinite Matrices. SIAM J. Optim. 5, 1995 (such
//   a matrix has a factorisation in every order).
// Departures: angles are those of the deformed mesh, not the slopes of a flat one.
#include "taut/report/static_plates.hpp"

#include <cmath>

namespace taut::reference {
namespace {

constexpr int kRefinements = 3; // each gains the digits of fp64

HingeAngle<Real> angle_of(const BendElement& h, const State& x)
{
    return hinge_angle<Real>({x[h.edge0], x[h.edge1], x[h.wing0], x[h.wing1]});
}

/// A m.
Real product(const PlateHinge& h, const std::vector<Real>& m, std::size_t own)
{
    Real sum = static_cast<Real>(h.softness) * m[own];
    for (std::size_t n = 0; n < 4; ++n)
        sum += static_cast<Real>(h.coupling[n]) * m[h.neighbour[n] / 2];
    return sum;
}

} // namespace

StaticPlates::StaticPlates(std::span<const PlateHinge> hinges) : hinges_(hinges)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < hinges.size(); ++k)
    {
        entries.emplace_back(static_cast<int>(k), static_cast<int>(k), 1.0);
        for (std::size_t n = 0; n < 4; ++n)
        {
            const std::size_t other = hinges[k].neighbour[n] / 2;
            entries.emplace_back(static_cast<int>(k), static_cast<int>(other),
                                 hinges[k].coupling[n] / (unit(k) * unit(other)));
        }
    }
    scaled_.resize(static_cast<int>(hinges.size()), static_cast<int>(hinges.size()));
    scaled_.setFromTriplets(entries.begin(), entries.end());
    if (!hinges.empty())
        factor_.compute(scaled_);
}

double StaticPlates::unit(std::size_t hinge) const { return std::sqrt(hinges_[hinge].softness); }

std::vector<Real> StaticPlates::turns(const State& x) const
{
    std::vector<Real> out;
    for (const PlateHinge& h : hinges_)
    {
        const auto hinge = angle_of(h.element, x);
        out.push_back(hinge.valid ? angle_difference(hinge.angle, h.element.rest_angle) : 0);
    }
    return out;
}

std::vector<Real> StaticPlates::moments(const State& x) const
{
    const std::vector<Real> turn = turns(x);
    std::vector<Real> out(turn.size());
    Eigen::VectorXd left(static_cast<Eigen::Index>(turn.size()));
    for (int i = 0; i < 1 + kRefinements && !turn.empty(); ++i)
    {
        for (std::size_t k = 0; k < turn.size(); ++k)
            left[static_cast<Eigen::Index>(k)] =
                static_cast<double>(turn[k] - product(hinges_[k], out, k)) / unit(k);
        const Eigen::VectorXd more = factor_.solve(left);
        for (std::size_t k = 0; k < turn.size(); ++k)
            out[k] += static_cast<Real>(more[static_cast<Eigen::Index>(k)] / unit(k));
    }
    return out;
}

Real StaticPlates::energy(const State& x) const
{
    const std::vector<Real> turn = turns(x), moment = moments(x);
    Real sum = 0;
    for (std::size_t k = 0; k < turn.size(); ++k)
        sum += turn[k] * moment[k] / 2;
    return sum;
}

void StaticPlates::add_gradient(const State& x, State& g) const
{
    const std::vector<Real> moment = moments(x);
    for (std::size_t k = 0; k < moment.size(); ++k)
    {
        const BendElement& h = hinges_[k].element;
        const auto hinge = angle_of(h, x);
        if (!hinge.valid)
            continue;
        const std::array<std::uint32_t, 4> v = {h.edge0, h.edge1, h.wing0, h.wing1};
        for (std::size_t c = 0; c < 4; ++c)
            g[v[c]] = g[v[c]] + moment[k] * hinge.gradient[c];
    }
}

void StaticPlates::add_rows(const State& x, int first, std::span<const int> unknown,
                            std::vector<Eigen::Triplet<double>>& entries) const
{
    for (std::size_t k = 0; k < hinges_.size(); ++k)
    {
        const BendElement& h = hinges_[k].element;
        const auto hinge = angle_of(h, x); // no gradient where it is not valid
        const std::array<std::uint32_t, 4> v = {h.edge0, h.edge1, h.wing0, h.wing1};
        const int row = first + static_cast<int>(k);
        for (std::size_t c = 0; c < 4; ++c)
        {
            if (unknown[v[c]] < 0)
                continue;
            const Vec<Real>& part = hinge.gradient[c];
            const Real parts[3] = {part.x, part.y, part.z};
            for (int axis = 0; axis < 3; ++axis)
                entries.emplace_back(row, unknown[v[c]] + axis, static_cast<double>(parts[axis]) / unit(k));
        }
    }
    for (int column = 0; column < scaled_.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator it(scaled_, column); it; ++it)
            if (it.row() >= it.col())
                entries.emplace_back(first + static_cast<int>(it.row()), first + static_cast<int>(it.col()),
                                     -it.value());
}

} // namespace taut::reference
