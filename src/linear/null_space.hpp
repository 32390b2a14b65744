#pragma once
// Taking a known null space out of vectors, on the host.

#include "taut/linear/solve.hpp"

namespace taut::linear {

/// Orthonormal vectors that span a null space; empty: nothing is projected.
class NullBasis
{
public:
    /// Throws Error{bad_input} for given vectors of another length than n, that are not finite or depend on
    /// each other, and for one that A does not map to zero (within 1e-8 of |A|_inf).
    NullBasis(const SparseMatrix&, NullSpace, std::span<const std::vector<double>> given);

    bool empty() const { return vectors_.empty(); }
    /// v -= Z Z^T v; returns |Z Z^T v|.
    double project(std::span<double> v) const;

private:
    std::vector<std::vector<double>> vectors_;
};

} // namespace taut::linear
