#pragma once
// Operators that are known without a matrix.

#include "taut/kernels/stencil7.hpp"
#include "taut/linear/operator.hpp"

namespace taut::linear {

/// The 7-point Laplacian on nx x ny x nz unknowns with zero values around, unknown (i, j, k) at
/// (k ny + j) nx + i: `scale` times 6 on the diagonal and -1 beside it, as poisson3d(n) (sparse.hpp) for
/// nx = ny = nz = n. It forms a product again instead of storing it: conjugate gradients take no
/// preconditioner then (its diagonal is constant: Jacobi would change nothing) and move 9 words a row and
/// iteration.
class Stencil7 : public Operator
{
public:
    /// Throws Error{bad_input} when a size is 0, or `scale` is not a positive number that float holds exactly
    /// (every precision solves the same system); Error{limit} for 2^31 unknowns or more.
    Stencil7(std::uint32_t nx, std::uint32_t ny, std::uint32_t nz, Precision, double scale = 1);

    std::uint32_t rows() const override { return nx_ * ny_ * nz_; }
    Precision precision() const override { return precision_; }
    std::uint64_t bytes() const override { return 0; }

    /// An empty `y` asks for the partial sums alone.
    void record_product(Recorder&, const Gate&, Binding x, Binding y, Binding partials) const override;
    void record_residual(Recorder&, const Gate&, Binding x, Binding b, Binding r) const override;
    void record_residual_pairs(Recorder&, const Gate&, Binding x, Binding b, Binding r) const override;
    bool recomputes() const override { return true; }
    void record_step(Recorder&, const Gate&, const StepBuffers&) const override;

private:
    void record(Recorder&, const Gate&, std::string_view variant,
                const kernels::stencil7::Bindings<Binding>&) const;

    std::uint32_t nx_, ny_, nz_;
    Precision precision_;
    float scale_;
};

} // namespace taut::linear
