#pragma once
// A matrix on a device in one of the formats.

#include "taut/linear/format.hpp"
#include "taut/linear/operator.hpp"

namespace taut::linear {

struct UploadOptions
{
    Format format = Format::csr; ///< not automatic
    Precision precision = Precision::float64;
    bool pairs = false; ///< float only: keep the low words of values that float cannot hold (for `mixed`)
    int exponent = 0;   ///< values are multiplied by 2^exponent (exact); the solver chooses it
    bool rectangular = false; ///< csr only: products and residuals without partials; x has `columns` entries
    bool rewritable = false;  ///< values() will be rewritten: no low words are kept, A is what values() hold
};

/// Packed once; the pattern stays. Values may be rewritten on the device by kernels of the caller, with
/// `pairs` only if `rewritable` says so.
class DeviceMatrix : public Operator
{
public:
    /// Largest |value| of the matrix has exponent 0 after 2^exponent: the way to solve 1e30 as well as 1e-30.
    static int scale_exponent(const SparseMatrix&);

    /// Throws what check_structure throws; Error{limit} for more than kMostRows rows or, with padding, more
    /// than kMostEntries entries, and naming format and bytes when a buffer would be larger than the device
    /// allows, or a row is longer than the kernel's loops may go;
    /// Error{bad_input} for a matrix that is not square, or bcsr3 with rows no multiple of 3.
    static std::shared_ptr<DeviceMatrix> upload(const std::shared_ptr<Device>&, const SparseMatrix&,
                                                const UploadOptions&);

    virtual Format format() const = 0;
    /// Values in the format's order: one buffer of reals that kernels of the caller may rewrite; padding is
    /// zero and must stay so. Not with low words (`pairs` without `rewritable`): record_residual_pairs adds
    /// to every value the low word of the one that was uploaded.
    virtual BufferPtr values() const = 0;
    /// For entry k of the host matrix (its order) the index in values(). For assembling on the device.
    virtual std::vector<std::uint32_t> slots(const SparseMatrix&) const = 0;
};

} // namespace taut::linear
