#pragma once
// Internal to src/plan: springs as implicit constraints (docs/methods/implicit_constraints.md).

#include "taut/plan/constraint_system.hpp"
#include "taut/plan/corner_rows.hpp"
#include "taut/plan/solve.hpp"

#include <cmath>
#include <optional>

namespace taut {

class Refusals;

/// What the method keeps while a plan is made.
struct ImplicitConstraints
{
    std::vector<StretchElement> elements; ///< the constrained springs, in plan vertices
    std::vector<double> compliances;      ///< m/N, of each as a row
    CornerSet corners;                    ///< tetrahedra and hinges
    Incidence at;
    ConstraintRows rows;
    std::uint32_t multiplier = kNoBuffer; ///< real a row; with more than one solve a substep
    std::optional<ConstraintMatrix> matrix;
    std::optional<PlanSolve> solve;
};

/// Whether a spring becomes a constraint under implicit_constraints, or may become one under acad.
bool may_be_constrained(const Scene& scene, const StretchElement& spring);

/// Throws Error{degenerate_rest} for a constrained spring without a length at rest.
void check_constrained_lengths(const Scene& resolved, Refusals& out);
/// Refuses other integrators than "semi_implicit" as `unsupported`.
void check_semi_implicit(const Scene& resolved, Refusals& out);
void check_implicit_constraints(const Scene& resolved, Refusals& out);

/// The compliance [m/N] of each spring as a row: the scene's, or where that is "material" the spring's own
/// (under acad none: beyond the threshold its own would be softer than the spring). Rows of a
/// body with more different ones than its vertices have directions to move in, and redundant ones elsewhere
/// (redundant_rows.hpp), have at least kRegularisation of what makes a row's diagonal: their system is
/// singular, and in motion nothing solves it. Rows that contradict each other have kContradiction of it:
/// what pulls against each other must stay small beside what carries, or float does not solve it.
std::vector<double> row_compliances(const PlanBuilder& builder, std::span<const StretchElement> springs);
inline constexpr double kContradiction = 1e-2;
/// N/m: 1/compliance as a Real, 0 where that is infinite: too little compliance for the precision is none.
template <typename Real>
Real row_stiffness(double compliance)
{
    const Real value = compliance > 0 ? static_cast<Real>(1 / compliance) : Real(0);
    return std::isfinite(value) ? value : Real(0);
}
/// kg: one over the diagonal of A in the row of a spring.
double inverse_diagonal(const PlanBuilder& builder, const StretchElement& spring, double compliance);
/// layout::Spring<real> a spring, as constraint_rows.comp reads them.
std::uint32_t add_row_records(PlanBuilder& builder, std::string_view effect,
                              const std::vector<StretchElement>& springs,
                              std::span<const double> compliances);
/// Throws Error{limit} where a vertex has more rows than one invocation may loop over.
void check_row_trips(const PlanBuilder& builder, const Incidence& at, std::uint32_t chunk);

void prepare_implicit_constraints(PlanBuilder& builder);
void record_implicit_constraints(PlanBuilder& builder, const Moment& moment);

} // namespace taut
