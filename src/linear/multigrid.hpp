#pragma once
// One V-cycle of smoothed aggregation as a preconditioner: passes of products alone, set up on the host.

#include "taut/linear/aggregation.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/preconditioner.hpp"

#include <memory>
#include <vector>

namespace taut::linear {

/// z = V(r): a Chebyshev polynomial before and the same one after the correction from the next level, so that
/// V is symmetric and, with intervals that hold the largest eigenvalues, positive definite.
class Multigrid : public StoredPreconditioner
{
public:
    /// `fine` is the operator of hierarchy.levels[0] on the device, with values times 2^exponent.
    Multigrid(std::shared_ptr<Device>, const AggregationHierarchy&, std::shared_ptr<const Operator> fine,
              int exponent);

    void record(Recorder&, const Gate&, Operator::Binding r, Operator::Binding z,
                Operator::Binding partials) const override;
    std::uint64_t bytes() const override { return bytes_; }

private:
    struct Level
    {
        std::shared_ptr<const Operator> matrix;
        std::shared_ptr<const Operator> prolongation; ///< negative, so that a correction is a residual
        std::shared_ptr<const Operator> restriction;
        std::shared_ptr<const Chebyshev> smoother;
        BufferPtr right, out; ///< what a coarser level is given, and gives back
        BufferPtr smooth, corrected, rest;
    };

    void record_level(Recorder&, const Gate&, std::size_t level, Operator::Binding r,
                      Operator::Binding z) const;
    BufferPtr make_vector(std::uint32_t rows, std::string_view label);

    std::shared_ptr<Device> device_;
    std::vector<Level> levels_;
    Precision precision_;
    std::uint64_t bytes_ = 0;
};

} // namespace taut::linear
