#pragma once
// Many small systems, one work group each: the whole solve of a system in one dispatch.

#include "taut/linear/cg.hpp"
#include "taut/linear/sparse.hpp"

namespace taut::linear {

/// Largest system of one group.
inline constexpr std::uint32_t kSmallRows = 1024;

/// A batch of compressed-row systems on a device, solved side by side by CG with a diagonal preconditioner.
/// Same statuses, same checks of the true residual as ConjugateGradient; float, double or pairs.
class SmallBatch
{
public:
    /// Values are multiplied by 2^exponents[k]. `inverses[k]` has a value a row (jacobi_inverse, spai0_inverse, or
    /// all 1), already scaled. Throws Error{limit} naming the system with more than kSmallRows rows, or whose
    /// iteration alone would pass the loop limit of 32,000 trips.
    SmallBatch(std::shared_ptr<Device>, std::span<const SparseMatrix> systems, std::span<const int> exponents,
               std::span<const std::vector<double>> inverses, Precision, bool pairs);

    /// One settings for all. b and x0 of all systems one behind the other. Replays until every system has ended
    /// (one dispatch where no system needs more trips than a dispatch may make).
    void set(const CgSettings&);
    void start(std::span<const double> b, std::span<const double> x0);
    std::uint32_t run(); ///< returns the number of dispatches
    CgOutcome outcome(std::size_t system);
    std::vector<double> x(std::size_t system);
    std::vector<float> history(std::size_t system); ///< |r| / |b|, at most ConjugateGradient::kHistory last ones

private:
    struct Parts;
    std::shared_ptr<Parts> parts_;
};

} // namespace taut::linear
