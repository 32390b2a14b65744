#pragma once
// A preconditioner of a matrix on the host, scaled and put on a device for one solve.

#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/solve.hpp"

#include <vector>

namespace taut::linear {

/// What a preconditioner is made for: A, the same times 2^exponent on the device, and what the caller wants.
struct PreconditionerInput
{
    const SparseMatrix& a;
    int exponent = 0;
    Precision precision = Precision::float64;
    const SolveOptions& options;
};

/// The inverse of the scaled matrix as preconditioner.hpp lays it out for `kind` (none: ones), 0 in held
/// rows, within the range of the precision.
std::vector<double> scaled_inverse(const PreconditionerInput&, Preconditioner kind);

/// options.preconditioner for `matrix`. Plain conjugate gradients with held rows come as a diagonal of ones.
Preconditioning make_preconditioning(const std::shared_ptr<Device>&, const PreconditionerInput&,
                                     const std::shared_ptr<const Operator>& matrix);

} // namespace taut::linear
