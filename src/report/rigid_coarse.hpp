#pragma once
// A small system beside a large one: groups of neighbouring vertices that move as rigid bodies.

#include "taut/report/block_matrix.hpp"

#include <Eigen/SparseCholesky>

#include <cstdint>
#include <vector>

namespace taut::reference {

/// z = T (T^T A T)^-1 T^T r, T the up to six rigid motions of each group of vertices.
class RigidCoarse
{
public:
    /// Groups of up to `size` vertices that A couples, grown breadth first; place [m] of each vertex.
    RigidCoarse(const BlockMatrix& a, const Columns& place, std::uint32_t size);

    /// Adds the motion that the small system gives for the forces r.
    void add_motion(const Columns& r, Columns& z) const;
    std::size_t groups() const { return groups_.size(); }

private:
    using Basis = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;
    struct Group
    {
        std::vector<std::uint32_t> vertices;
        Basis basis; ///< independent motions, each of them a translation [m] and a turn [rad times `radius`]
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        double radius = 1;      ///< m
        Eigen::Index first = 0; ///< unknown of the small system
    };

    void gather(const BlockMatrix& a, std::uint32_t size);
    void find_motions(const Columns& place);
    void factor(const BlockMatrix& a);
    /// Turn [rad times the group's radius] to motion, of a vertex.
    Eigen::Matrix3d turn(std::uint32_t vertex) const;

    std::vector<Group> groups_;
    std::vector<std::uint32_t> group_; ///< of each vertex
    Columns arm_;                      ///< from the centre of the group, over its radius
    Eigen::Index unknowns_ = 0;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
};

} // namespace taut::reference
