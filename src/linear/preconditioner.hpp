#pragma once
// Approximate inverses that are cheap to apply on every device: no triangular solves.

#include "taut/linear/operator.hpp"
#include "taut/linear/sparse.hpp"

#include <memory>
#include <string_view>

namespace taut::linear {

enum class Preconditioner : std::uint8_t
{
    none,
    jacobi,       ///< 1 / a_ii
    block_jacobi, ///< inverse of each 3 x 3 block on the diagonal; rows must be a multiple of 3
    chebyshev,    ///< polynomial in D^-1 A, no dot products
    multigrid,    ///< a V-cycle of smoothed aggregation (multigrid.hpp); no held rows
    spai0,        ///< diagonal m that minimises |I - diag(m) A|_F: a_ii / sum_j a_ij^2
};
std::string_view to_string(Preconditioner);
/// Throws Error{bad_input} listing the words ("none", "jacobi", "block_jacobi", "chebyshev", "multigrid",
/// "spai0").
Preconditioner preconditioner_from(std::string_view word);

// Each of these works on the system of the rows that are not held. Held rows out of range, and a diagonal
// that is not finite and positive (but in a held or a zero row), are Error{bad_input} that names the row.

/// One value a row; 0 for rows of `held`, whose entry of x then never changes. A zero row gets 1.
std::vector<double> jacobi_inverse(const SparseMatrix&, std::span<const std::uint32_t> held = {});
/// Broeker, Grote. Sparse approximate inverse smoothers for geometric and algebraic multigrid. 2002 (SPAI-0).
std::vector<double> spai0_inverse(const SparseMatrix&, std::span<const std::uint32_t> held = {});
/// Six values a block row: xx xy xz yy yz zz; a held row's are 0 and the others' block is inverted without
/// it. `rounding` is the rounding unit of the reals that will hold them: a block too near to singular for it
/// (scaled to a unit diagonal, an eigenvalue below some 64 units) is shifted that far, so that the rounded
/// inverse is positive definite too.
/// Throws Error{bad_input} when rows is no multiple of 3 or a block is not positive definite, naming it.
std::vector<double> block_jacobi_inverse(const SparseMatrix&, std::span<const std::uint32_t> held = {},
                                         double rounding = 0x1p-53);

/// Interval that holds the eigenvalues of D^-1 A that a polynomial should treat.
struct Interval
{
    double lowest = 0;
    double highest = 0;
};
/// Upper end: 15 steps of Lanczos on the host from a fixed start, times 1.05, at most Gershgorin's bound.
/// Lower end: the upper one / `spread`.
Interval chebyshev_interval(const SparseMatrix&, std::span<const double> inverse_diagonal,
                            double spread = 30);

/// A preconditioner whose z = M^-1 r takes passes of its own and is stored. A caller's own one derives from
/// this; it must be symmetric, positive definite, and the same linear map every time.
class StoredPreconditioner
{
public:
    virtual ~StoredPreconditioner() = default;

    /// z from r. Where `partials` is a buffer also partials[g] = sum of r_i z_i over the rows of group g of
    /// make_grid(rows, gate.groups).
    virtual void record(Recorder&, const Gate&, Operator::Binding r, Operator::Binding z,
                        Operator::Binding partials) const = 0;
    virtual std::uint64_t bytes() const = 0; ///< device bytes of matrices, tables and vectors it holds
};

/// z = q(D^-1 A) D^-1 r with q of degree `degree` - 1: degree - 1 products and no dot product but the last.
/// Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, algorithm 12.1.
class Chebyshev : public StoredPreconditioner
{
public:
    /// `inverse` holds rows() reals, 1 / d_ii, and 0 in held rows, where z is then 0. degree in 1..16. With
    /// an interval whose `highest` is above the eigenvalues of D^-1 A the preconditioner is symmetric
    /// positive definite (chebyshev.cpp says why). Throws Error{bad_input}.
    Chebyshev(std::shared_ptr<Device>, std::shared_ptr<const Operator>, BufferPtr inverse, Interval,
              int degree);

    void record(Recorder&, const Gate&, Operator::Binding r, Operator::Binding z,
                Operator::Binding partials) const override;
    std::uint64_t bytes() const override;

    const BufferPtr& inverse() const { return inverse_; }

private:
    std::shared_ptr<const Operator> operator_;
    BufferPtr inverse_, other_, product_;
    Interval interval_;
    int degree_ = 4;
};

} // namespace taut::linear
