#pragma once
// A preconditioner of two levels: 3 x 3 blocks, and the translations of aggregates of vertices.

#include "taut/linear/device_matrix.hpp"
#include "taut/linear/preconditioner.hpp"

#include <memory>
#include <span>
#include <vector>

namespace taut::linear {

/// z = D^-1 r + P A_c^-1 P^T r with A_c = P^T A P, where P gives the vertices of an aggregate one
/// translation. Symmetric and positive definite. For a matrix in bcsr3 whose values are rewritten on the
/// device: form() takes A_c and its inverse from them.
class TwoLevel : public StoredPreconditioner
{
public:
    /// `inverse`: D^-1, six reals a block row (DeviceInverse with block_jacobi); where a diagonal value of it
    /// is 0 the row is held, and z is 0. `aggregate`: of each block row, numbered from 0, or kNoPart
    /// (partition.hpp). Throws Error{bad_input} for another format or more than kMostAggregates, Error{limit}
    /// where an aggregate has more blocks than a device's loops may go.
    TwoLevel(std::shared_ptr<Device>, std::shared_ptr<const DeviceMatrix>, const SparseMatrix& pattern,
             BufferPtr inverse, std::span<const std::uint32_t> aggregate);

    /// A_c and its inverse from the matrix' values: 3 n dispatches for n aggregates. Between two calls the
    /// matrix may change: the preconditioner stays one, of an older matrix.
    void form(Recorder&, const Gate&) const;
    void record(Recorder&, const Gate&, Operator::Binding r, Operator::Binding z,
                Operator::Binding partials) const override;
    std::uint64_t bytes() const override;

    /// Its inverse is dense, and formed by as many passes as it has rows.
    static constexpr std::uint32_t kMostAggregates = 80;

private:
    std::uint32_t rows() const { return 3 * aggregates_; }

    std::shared_ptr<const DeviceMatrix> matrix_;
    std::uint32_t aggregates_ = 0;
    BufferPtr inverse_, aggregate_, pairs_, blocks_, members_;
    BufferPtr coarse_, other_; ///< A_c, in the end -A_c^-1; the sweeps go to and fro
    BufferPtr right_, left_;   ///< P^T r, and -A_c^-1 P^T r
};

} // namespace taut::linear
