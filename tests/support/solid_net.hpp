#pragma once
// Nets of elastic tetrahedra for the tests of kernels/implicit, and the matrix of a Newton step by their
// states.

#include "support/implicit_net.hpp"
#include "support/tetrahedra.hpp"
#include "taut/kernels/shared/solid_state.h"

#include <glm/matrix.hpp>

namespace taut::conformance {

template <typename Real>
struct SolidNet
{
    Net<Real> net; ///< without springs and hinges
    std::vector<layout::SolidTetrahedron<Real>> solids;
    std::vector<std::uint32_t> table;

    std::array<std::uint32_t, 4> corners(std::size_t k) const
    {
        return {solids[k].a, solids[k].b, solids[k].c, solids[k].d};
    }
};

template <typename Real>
glm::dmat3 inverse_rest(const layout::SolidTetrahedron<Real>& t)
{
    return {glm::dvec3(t.b00, t.b10, t.b20), glm::dvec3(t.b01, t.b11, t.b21),
            glm::dvec3(t.b02, t.b12, t.b22)};
}

template <typename Real>
glm::dmat3 edges_of(const SolidNet<Real>& in, std::size_t k)
{
    const auto v = in.corners(k);
    return {in.net.between(v[0], v[1]), in.net.between(v[0], v[2]), in.net.between(v[0], v[3])};
}

/// What F is on corner c: columns of F change by this times the corner.
template <typename Real>
glm::dvec3 row_of(const layout::SolidTetrahedron<Real>& t, std::size_t corner)
{
    const glm::dmat3 rows = glm::transpose(inverse_rest(t));
    return corner == 0 ? -(rows[0] + rows[1] + rows[2]) : rows[static_cast<int>(corner) - 1];
}

/// Tables and marks of what is solved for; `diagonal_only` as in the net.
template <typename Real>
void make_solid_table(SolidNet<Real>& in);

/// `shapes` tetrahedra on `count` vertices, at first deformed by up to a half; then with the models and
/// states that are special, one after the other: at rest, mirrored, flat, a point, without shear stiffness,
/// squeezed.
template <typename Real>
SolidNet<Real> random_solids(std::uint32_t count, std::uint32_t shapes, std::uint64_t seed);

/// Blocks of the matrix by the chain rule, from random or real states.
template <typename Real>
std::map<Place, SizedBlock> solid_system(const SolidNet<Real>& in, const std::vector<Real>& state);

} // namespace taut::conformance
