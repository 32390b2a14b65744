#pragma once
// The energy of a model over its moving vertices, with gradient and Hessian: what reference_static minimises.

#include "taut/report/hinge.hpp"
#include "taut/report/model.hpp"

#include <Eigen/SparseCore>

#include <functional>
#include <span>
#include <vector>

namespace taut::reference {

/// Long double, because at 1e6 N/m one fp64 rounding of a position is a force far above 1e-12 of the weight.
using Real = long double;
using State = std::vector<Vec<Real>>; ///< one a vertex, pinned ones too

/// Projected: positive semidefinite; the exact Hessian of cloth that is slack or folded is not.
enum class Curvature { exact, projected };

class StaticEnergy
{
public:
    explicit StaticEnergy(const PhysicalModel& model);

    Real value(const State& x) const;     ///< J; without plates and added elements
    State gradient(const State& x) const; ///< N; zero at pins; without these, too
    /// N/m; shift * mass is added to the diagonal (1/s^2). The lower triangle, one pattern for all x. Plates
    /// are as stiff as the bound of PlateHinge::element, each hinge for itself; added ones as
    /// added_stiffness.hpp has them.
    Eigen::SparseMatrix<double> hessian(const State& x, Curvature curvature, double shift) const;

    /// The 3 x 3 blocks that hessian() adds up, N/m, in a fixed order and with (b, a) beside (a, b): of every
    /// element at every two of its vertices, and shift * mass at each vertex; those of pins, too.
    using Block = std::function<void(std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d&)>;
    void blocks(const State& x, Curvature curvature, double shift, const Block& visit) const;
    /// The vertices of every element, in the order of blocks().
    void elements(const std::function<void(std::span<const std::uint32_t>)>& visit) const;

    int unknowns() const { return unknowns_; }
    /// First of the three unknowns of a vertex; -1 = pinned.
    int unknown(std::size_t vertex) const { return unknown_[vertex]; }

private:
    const PhysicalModel& model_;
    std::vector<SolidElement> solids_; ///< elastic ones, and held volumes as such without shear stiffness
    std::vector<int> unknown_;
    int unknowns_ = 0;
};

/// Largest component; infinite when one is not a number.
double largest_component(const State& a);

} // namespace taut::reference
