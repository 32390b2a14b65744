// Based on: Tang, Nabben, Vuik, Erlangga. Comparison of Two-Level Preconditioners Derived from Deflation,
//   Domain Decomposition and Multigrid Methods. J. Sci. Comput. 39, 2009 (A-DEF2: z = y + Q (r - A y), from
//   the start Q b); Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, section 4.1 (symmetric
//   Gauss-Seidel, by blocks).
// Departures: r - A y after symmetric Gauss-Seidel, M = (D + L) D^-1 (D + U), is L (s - y) with s the result
//   of its first sweep: half a product instead of a whole one.

#include "taut/report/rigid_gradients.hpp"

#include <Eigen/LU>

#include <utility>

namespace taut::reference {
namespace {

double dot(const Columns& a, const Columns& b) { return a.cwiseProduct(b).sum(); }

} // namespace

RigidGradients::RigidGradients(const BlockMatrix& a, const Columns& place, std::uint32_t group_size)
    : a_(a),
      coarse_(a, place, group_size),
      inverse_(a.rows())
{
    for (std::uint32_t row = 0; row < a.rows(); ++row)
        inverse_[row] = a.diagonal(row).inverse();
}

Columns RigidGradients::precondition(const Columns& r) const
{
    Columns first(3, r.cols());
    for (std::uint32_t row = 0; row < a_.rows(); ++row)
    {
        Eigen::Vector3d left = r.col(row);
        a_.each_below(row, [&](std::uint32_t column, const Eigen::Matrix3d& block) {
            left -= block * first.col(column);
        });
        first.col(row) = inverse_[row] * left;
    }
    Columns above = Columns::Zero(3, r.cols()); // U y, as far as y is known
    Columns y(3, r.cols());
    for (std::uint32_t row = a_.rows(); row-- > 0;)
    {
        y.col(row) = first.col(row) - inverse_[row] * above.col(row);
        const Eigen::Vector3d own = y.col(row);
        a_.each_below(row, [&](std::uint32_t column, const Eigen::Matrix3d& block) {
            above.col(column) += block.transpose() * own;
        });
    }
    coarse_.add_motion(a_.below_times(first - y), y);
    return y;
}

Columns RigidGradients::solve(const Columns& b, const Settled& settled, int most) const
{
    Columns x = Columns::Zero(3, b.cols());
    coarse_.add_motion(b, x);
    Columns r = b - a_.times(x), z = precondition(r), p = z;
    double size = dot(r, z);
    bool done = settled(x);
    for (int i = 1; i <= most && !done && size > 0; ++i)
    {
        const Columns image = a_.times(p);
        const double curvature = dot(p, image);
        if (!(curvature > 0))
            break;
        x += size / curvature * p;
        r -= size / curvature * image;
        z = precondition(r);
        const double before = std::exchange(size, dot(r, z));
        p = z + size / before * p;
        done = i % kIterationsALook == 0 && settled(x);
    }
    return x;
}

} // namespace taut::reference
