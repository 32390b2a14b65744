#pragma once
// What a Newton step needs of an elastic tetrahedron in fp64: the derivative of its stress by definition,
// its negative eigenvalues made positive.

#include <Eigen/Core>
#include <glm/mat3x3.hpp>

#include <vector>

namespace taut::conformance {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Columns of a matrix as one vector.
Eigen::Matrix<double, 9, 1> flat(const glm::dmat3& m);

glm::dmat3 cofactor_of(const glm::dmat3& f);

struct Elastic
{
    double mu = 0, lambda = 0, rest = 1, log = 0;
};

glm::dmat3 stress_of(const Elastic& m, const glm::dmat3& f);

/// dP/dF: columns are what a unit change of an entry of F does. The cofactor is quadratic in F, so half of
/// its central difference with a step of 1 is its derivative.
Matrix9 stress_derivative(const Elastic& m, const glm::dmat3& f);

/// Every negative eigenvalue becomes a sixteenth of its size (kernels/shared/solid_curvature.glsl).
Matrix9 turned_positive(const Matrix9& a);

/// The reals of a tetrahedron (kernels/shared/solid_state.h) in their order.
std::vector<double> state_of(const glm::dmat3& stress, const Matrix9& k);

} // namespace taut::conformance
