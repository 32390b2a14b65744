#pragma once
// Internal to src/plan: springs as implicit constraints (docs/methods/implicit_constraints.md).

#include "taut/plan/constraint_system.hpp"
#include "taut/plan/solve.hpp"

#include <optional>

namespace taut {

/// What the method keeps while a plan is made.
struct ImplicitConstraints
{
    std::vector<StretchElement> elements; ///< the constrained springs, in plan vertices
    Incidence at;
    ConstraintRows rows;
    std::uint32_t multiplier = kNoBuffer; ///< real a row; with more than one solve a substep
    std::optional<ConstraintMatrix> matrix;
    std::optional<PlanSolve> solve;
};

/// Whether a spring becomes a constraint under implicit_constraints, or may become one under acad.
bool may_be_constrained(const Scene& scene, const StretchElement& spring);

/// Throws Error{degenerate_rest} for a constrained spring without a length at rest.
void check_constrained_lengths(const Scene& resolved);
void check_implicit_constraints(const Scene& resolved, const DeviceTraits&);

/// The compliance [m/N] that a constrained spring has as a row: the scene's, or where that is "material" the
/// spring's own (under acad none: beyond the threshold its own would be softer than the spring).
double row_compliance(const Scene& scene, const StretchElement& spring);
/// kg: one over the diagonal of A in the row of a spring.
double inverse_diagonal(const PlanBuilder& builder, const StretchElement& spring);
/// layout::Spring<real> a spring, as constraint_rows.comp reads them.
std::uint32_t add_row_records(PlanBuilder& builder, std::string_view effect,
                              std::span<const StretchElement> springs);
/// Throws Error{limit} where a vertex has more rows than one invocation may loop over.
void check_row_trips(const PlanBuilder& builder, const Incidence& at, std::uint32_t chunk);

void prepare_implicit_constraints(PlanBuilder& builder);
void record_implicit_constraints(PlanBuilder& builder, const Moment& moment);

} // namespace taut
