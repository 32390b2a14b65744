#pragma once
// The inverse that conjugate gradients precondition with, formed on the device.

#include "taut/linear/device_matrix.hpp"
#include "taut/linear/preconditioner.hpp"

#include <memory>

namespace taut::linear {

/// For a matrix whose values are rewritten in every step: record() forms the inverse anew from values() with
/// no copy to the host, so that one recording holds the rewriting, the inverse and the solve.
class DeviceInverse
{
public:
    /// `kind` is jacobi or block_jacobi (else Error{unsupported}; block_jacobi with rows no multiple of 3:
    /// Error{bad_input}). `pattern` is the matrix that was uploaded; its values do not matter. `held` holds a
    /// 32-bit word a row, not 0 where the row is held, and may be rewritten too; null: none is.
    DeviceInverse(std::shared_ptr<Device>, std::shared_ptr<const DeviceMatrix>, const SparseMatrix& pattern,
                  Preconditioner kind, BufferPtr held = nullptr);

    /// After the passes that write values() and before ConjugateGradient::record_begin. What jacobi_inverse
    /// and block_jacobi_inverse give for the values on the device, in its reals; but where these refuse, and
    /// no kernel can, the inverse is one of a positive definite matrix all the same (diagonal_inverse.comp).
    void record(Recorder&, const Gate&) const;

    /// As Preconditioning::inverse takes it: rows() reals, or 2 * rows() with block_jacobi.
    const BufferPtr& inverse() const { return inverse_; }
    Preconditioner kind() const { return kind_; }
    std::uint64_t bytes() const; ///< of the inverse and its tables

private:
    std::shared_ptr<const DeviceMatrix> matrix_;
    Preconditioner kind_;
    BufferPtr slots_, held_, inverse_;
};

} // namespace taut::linear
