#pragma once
// A linear operator as passes on a device: what conjugate gradients need of a matrix. A matrix-free operator
// is a class of the caller that records kernels of its own.

#include "taut/linear/grid.hpp"

namespace taut::linear {

/// Square, symmetric, positive definite (or semidefinite on what the solve touches). Vectors are arrays of
/// `rows()` reals of `precision()`; pairs are 2 * rows() reals, high and low word in turn.
class Operator
{
public:
    using Binding = Recorder::Binding;
    virtual ~Operator() = default;

    virtual std::uint32_t rows() const = 0;
    virtual Precision precision() const = 0;
    /// Device bytes that one product reads of the operator itself (0: matrix-free).
    virtual std::uint64_t bytes() const = 0;

    /// y = A x. Where `partials` is a buffer also partials[g] = sum of x_i y_i over the units of group g, for
    /// all gate.groups groups.
    virtual void record_product(Recorder&, const Gate&, Binding x, Binding y, Binding partials) const = 0;
    /// r = b - A x.
    virtual void record_residual(Recorder&, const Gate&, Binding x, Binding b, Binding r) const = 0;
    /// r = b - A x where x and b are pairs and products and sums are formed in two floats (float only).
    /// By default Error{unsupported}: the operator cannot serve `mixed`.
    virtual void record_residual_pairs(Recorder&, const Gate&, Binding x, Binding b, Binding r) const;

    /// Where q = A p costs less to form again than to store and read: record_product is then called with an
    /// empty y, and record_step stands in for the pass `cg_step` (kernels/linear/cg_step.comp, whose buffers
    /// these are).
    virtual bool recomputes() const { return false; }
    struct StepBuffers
    {
        Binding direction, residual, curvatures, partials, before, after;
    };
    virtual void record_step(Recorder&, const Gate&, const StepBuffers&) const;
};

} // namespace taut::linear
