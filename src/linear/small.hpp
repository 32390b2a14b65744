#pragma once
// Many small systems, one work group each: the whole solve of a system in one dispatch.

#include "taut/linear/cg.hpp"
#include "taut/linear/sparse.hpp"

namespace taut::linear {

/// Largest system of one group.
inline constexpr std::uint32_t kSmallRows = TAUT_SMALL_ROWS;

/// A batch of compressed-row systems on a device, solved side by side by CG with a diagonal preconditioner.
/// Same statuses, same checks of the true residual as ConjugateGradient; float, double or pairs. What becomes
/// of a system does not depend, to the last bit, on the others of the batch.
class SmallBatch
{
public:
    /// Values are multiplied by 2^exponents[k]. `inverses[k]` has a value a row (jacobi_inverse,
    /// spai0_inverse, or all 1; 0: the row is held), already scaled. Throws, naming the system, Error{limit}
    /// for more than kSmallRows rows, or where not one turn fits the loop limit; Error{bad_input} for one
    /// that is not square, whose inverse does not fit, or with a value that overflows the precision;
    /// Error{unsupported} for double on a device without it.
    SmallBatch(std::shared_ptr<Device>, std::span<const SparseMatrix> systems, std::span<const int> exponents,
               std::span<const std::vector<double>> inverses, Precision, bool pairs);

    /// One settings for all; holds from the next start on. Throws Error{bad_input} as ConjugateGradient::set.
    void set(const CgSettings&);
    /// b and x0 of all systems one behind the other, scaled as the caller scales them. An empty x0 is zero.
    /// Throws Error{bad_input} unless they have rows() entries.
    void start(std::span<const double> b, std::span<const double> x0);
    /// Replays until every system has ended (one dispatch where no system needs more trips than one may
    /// make). Returns the number of dispatches.
    std::uint32_t run();

    std::size_t systems() const;
    std::uint32_t rows() const;               ///< of all systems together
    std::uint32_t turns(std::size_t) const;   ///< iterations and residuals formed anew that fit one dispatch
    std::uint64_t bytes() const;              ///< device bytes of everything
    CgOutcome outcome(std::size_t system);    ///< after run
    std::vector<double> x(std::size_t system);
    /// x as it was when the residual was last formed anew: what there is to fall back on when x is no better.
    std::vector<double> checked_x(std::size_t system);
    /// The last direction p, scaled as b.
    std::vector<double> direction(std::size_t system);
    /// |r| / |b|, at most ConjugateGradient::kHistory last ones.
    std::vector<float> history(std::size_t system);

private:
    struct Parts;
    std::shared_ptr<Parts> parts_;
};

} // namespace taut::linear
