// Based on: Griewank, Walther. Evaluating Derivatives. 2nd ed. 2008, 3.1 (dual numbers, over the energy of
//   elements/membrane.hpp).
// Departures: second derivatives are differences of these forces.
#include "taut/report/static_membranes.hpp"

#include "taut/elements/membrane.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace taut::reference {
namespace {

using Edges = std::array<std::array<Real, 3>, 2>; ///< m, from the first corner
using Slopes = std::array<Real, 6>;               ///< N, of the energy by both edges

constexpr Real kStep = 1e-6L; ///< of an edge: truncation and rounding of its differences are alike there

Edges edges_of(const AddedElement& e, const State& x)
{
    Edges out;
    for (std::size_t k = 0; k < 2; ++k)
    {
        const Vec<Real> d = x[e.vertex[k + 1]] - x[e.vertex[0]];
        out[k] = {d.x, d.y, d.z};
    }
    return out;
}

Slopes slopes(const AddedElement& element, const Edges& at)
{
    using Number = Dual<6, Real>;
    std::array<std::array<Number, 3>, 2> edges;
    for (std::size_t e = 0; e < 2; ++e)
        for (std::size_t k = 0; k < 3; ++k)
        {
            edges[e][k].v = at[e][k];
            edges[e][k].d[3 * e + k] = 1;
        }
    return taut::membrane_energy(edges[0], edges[1], element.values).d;
}

} // namespace

bool is_membrane(const AddedElement& element) { return is_own(*element.kind); }

Real membrane_energy(const AddedElement& element, const State& x)
{
    const Edges edges = edges_of(element, x);
    return taut::membrane_energy(edges[0], edges[1], element.values);
}

void add_membrane_gradient(const AddedElement& element, const State& x, State& g)
{
    const Slopes slope = slopes(element, edges_of(element, x));
    for (std::size_t e = 0; e < 2; ++e)
    {
        const Vec<Real> part{slope[3 * e], slope[3 * e + 1], slope[3 * e + 2]};
        g[element.vertex[e + 1]] = g[element.vertex[e + 1]] + part;
        g[element.vertex[0]] = g[element.vertex[0]] - part;
    }
}

Eigen::Matrix<double, 9, 9> membrane_stiffness(const AddedElement& element, const State& x)
{
    const Edges at = edges_of(element, x);
    Real longest = 0;
    for (const auto& edge : at)
        longest = std::max(longest, std::sqrt(edge[0] * edge[0] + edge[1] * edge[1] + edge[2] * edge[2]));
    Eigen::Matrix<double, 6, 6> by_edges = Eigen::Matrix<double, 6, 6>::Zero();
    for (std::size_t column = 0; column < 6 && longest > 0; ++column)
    {
        Edges more = at, less = at;
        more[column / 3][column % 3] += kStep * longest;
        less[column / 3][column % 3] -= kStep * longest;
        const Slopes up = slopes(element, more), down = slopes(element, less);
        for (std::size_t row = 0; row < 6; ++row)
            by_edges(static_cast<int>(row), static_cast<int>(column)) =
                static_cast<double>((up[row] - down[row]) / (2 * kStep * longest));
    }
    Eigen::Matrix<double, 6, 9> corners = Eigen::Matrix<double, 6, 9>::Zero(); // edges by corners
    corners.rightCols<6>().setIdentity();
    for (int k = 0; k < 6; ++k)
        corners(k, k % 3) = -1;
    return corners.transpose() * (0.5 * (by_edges + by_edges.transpose())) * corners;
}

} // namespace taut::reference
