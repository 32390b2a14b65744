#pragma once
// Internal to src/plan: a linear system that a method solves within its substeps, as passes of the plan.

#include "taut/linear/cg.hpp"
#include "taut/linear/device_inverse.hpp"
#include "taut/plan/builder.hpp"

#include <memory>
#include <string>
#include <vector>

namespace taut {

/// Conjugate gradients made on the builder's paper, with tolerance and limit of the scene's method, and
/// listed in plan.solvers. An effect makes one in `prepare` and records it as often as it solves.
class PlanSolve
{
public:
    using Inverses = std::vector<std::shared_ptr<const linear::DeviceInverse>>;

    /// Operator and inverse live on builder.paper(). The inverses of `formed` are formed anew before each
    /// solve; where there are none, passes of the caller fill preconditioning.inverse, and an inverse of 0
    /// holds a row. Throws what ConjugateGradient throws.
    PlanSolve(PlanBuilder& builder, std::string_view effect, std::shared_ptr<const linear::Operator>,
              linear::Preconditioning, Inverses formed = {});

    // Numbers of plan buffers, in reals: right-hand side, and solution (start value before, result after;
    // held rows keep theirs).
    std::uint32_t b() const { return b_; }
    std::uint32_t x() const { return x_; }
    /// Of the preconditioner, kNoBuffer where there is none: a real a row, or six a block row.
    std::uint32_t inverse() const { return inverse_; }

    /// layout::CgState<real>: how the last solve ended.
    std::uint32_t state() const { return state_; }

    /// As ConjugateGradient::use_part, with three words of a plan's buffer at `groups`, and three at `once`
    /// that say {1, 1, 1}, or {0, 1, 1} where there is nothing to solve. Before record.
    void use_part(PlanBuilder& builder, std::uint32_t control, std::uint64_t groups, std::uint64_t once);
    /// Buffers that a pass of the caller writes then: the solver's control words, and sums to clear.
    std::uint32_t control(PlanBuilder& b) const { return b.adopt(effect_, cg_.control()); }
    std::uint32_t partials(PlanBuilder& b) const { return b.adopt(effect_, cg_.partials()); }
    std::uint32_t curvatures(PlanBuilder& b) const { return b.adopt(effect_, cg_.curvatures()); }

    /// The whole solve: inverse, begin, room for as many iterations as the limit (zero groups once it has
    /// ended; where the residual is formed anew up to seven of them pass unused), end, log.
    void record(PlanBuilder& builder);

    /// Work groups of every pass over the rows, for passes of the caller that sum as the solver does.
    std::uint32_t groups() const { return groups_; }
    const linear::Operator& system() const { return *operator_; }

private:
    std::string effect_;
    std::shared_ptr<const linear::Operator> operator_;
    Inverses formed_;
    linear::ConjugateGradient cg_;
    std::uint32_t groups_ = 1, iterations_ = 0;
    std::uint32_t part_ = kNoBuffer; ///< where group counts lie, kNoBuffer: the whole system is in use
    std::uint64_t once_ = 0;
    std::uint32_t b_ = kNoBuffer, x_ = kNoBuffer, inverse_ = kNoBuffer, state_ = kNoBuffer, log_ = kNoBuffer;
};

} // namespace taut
