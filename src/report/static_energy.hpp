#pragma once
// The energy of a model over its moving vertices, with gradient and Hessian: what reference_static minimises.

#include "taut/report/model.hpp"
#include "taut/report/static_plates.hpp"

#include <Eigen/SparseCore>

#include <functional>
#include <span>
#include <vector>

namespace taut::reference {

class StaticEnergy
{
public:
    explicit StaticEnergy(const PhysicalModel& model);

    Real value(const State& x) const;     ///< J; of added elements membranes alone
    State gradient(const State& x) const; ///< N; zero at pins; of added elements membranes alone
    /// N/m; shift * mass is added to the diagonal (1/s^2). The lower triangle, one pattern for all x. Plates
    /// are as stiff as the bound of PlateHinge::element, each hinge for itself; added ones as
    /// added_stiffness.hpp has them.
    Eigen::SparseMatrix<double> hessian(const State& x, Curvature curvature, double shift) const;
    /// As hessian(), but of added elements membranes alone, to ten digits, and with plates as they are: after
    /// the coordinates come scaled moments of their hinges, as unknowns whose equations have a right-hand
    /// side of 0. The energy's Hessian is positive definite where this matrix has as many negative
    /// eigenvalues as there are such hinges (Haynsworth 1968).
    Eigen::SparseMatrix<double> system(const State& x, Curvature curvature, double shift) const;

    /// The 3 x 3 blocks that hessian() adds up, N/m, in a fixed order and with (b, a) beside (a, b): of every
    /// element at every two of its vertices, and shift * mass at each vertex; those of pins, too.
    using Block = std::function<void(std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d&)>;
    void blocks(const State& x, Curvature curvature, double shift, const Block& visit) const;
    /// The vertices of every element, in the order of blocks().
    void elements(const std::function<void(std::span<const std::uint32_t>)>& visit) const;

    int unknowns() const { return unknowns_; } ///< coordinates
    int plate_hinges() const { return static_cast<int>(plates_.count()); }
    /// First of the three unknowns of a vertex; -1 = pinned.
    int unknown(std::size_t vertex) const { return unknown_[vertex]; }

private:
    using Entries = std::vector<Eigen::Triplet<double>>;
    void elastic_blocks(const State& x, Curvature curvature, double shift, const Block& visit) const;
    void added_blocks(const State& x, Curvature curvature, const Block& visit) const;
    void add_lower(Entries& entries, std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) const;

    const PhysicalModel& model_;
    StaticPlates plates_;
    std::vector<SolidElement> solids_; ///< elastic ones, and held volumes as such without shear stiffness
    std::vector<int> unknown_;
    int unknowns_ = 0;
};

/// Largest component; infinite when one is not a number.
double largest_component(const State& a);

} // namespace taut::reference
