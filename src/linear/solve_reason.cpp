#include "taut/linear/solve_reason.hpp"

#include "taut/runtime/base/shown.hpp"

namespace taut::linear {
namespace {

/// What goes further than the precision in hand.
std::string advice(SolvePrecision precision)
{
    if (precision == SolvePrecision::float32)
        return "; \"mixed\" or \"double\" go further";
    return precision == SolvePrecision::mixed ? "; \"double\" may go further" : "";
}

std::string stagnation(const SolveReport& report, const CgOutcome& outcome, const std::string& where,
                       const std::string& after)
{
    const std::string precision(to_string(report.precision));
    if (outcome.misread)
        return precision + " finds a direction p with p.Ap = " + shown(outcome.curvature, 3) + " (scaled)" +
               after +
               "; of A itself it is positive, but its entries are too many decades apart for this precision" +
               advice(report.precision);
    if (outcome.cause == TAUT_CG_EXHAUSTED)
        return "the steepest descent from " + where + after + " has a curvature of " +
               shown(outcome.curvature_ratio, 3) + " of the largest, which " + precision +
               " cannot tell from zero: A is singular, or too ill-conditioned for this precision";
    if (outcome.cause == TAUT_CG_RAN_AWAY)
        return "the residual grew to " + shown(outcome.residual, 3) + " |b|" + after +
               ": the best iterate has " + where;
    if (outcome.cause == TAUT_CG_CONVERGED)
        return "the device's residual of " + shown(outcome.residual, 3) + after +
               " is below the tolerance, but " + where + " is not: " + precision + " holds no better x" +
               advice(report.precision);
    return "three residuals formed anew in a row were not half of the best before" + after +
           ": it stays at " + where + advice(report.precision);
}

} // namespace

std::string reason_of(const SolveReport& report, const CgOutcome& outcome, const SolveOptions& options,
                      bool beyond_double)
{
    const std::string where = "a true residual of " + shown(report.relative_residual, 3);
    const std::string after = " after " + std::to_string(report.iterations) +
                              (report.iterations == 1 ? " iteration" : " iterations");
    if (beyond_double && report.status != Status::converged)
        return "x is beyond the largest double, 1.8e308" + after + ": no precision holds it, and " + where +
               " is what is left; scale b down, or A up";
    switch (report.status)
    {
    case Status::converged:
        return where + " is within the tolerance of " + shown(options.tolerance, 3) + after;
    case Status::indefinite_matrix:
        return "a direction p with p.Ap = " + shown(outcome.curvature, 3) + " (scaled), " +
               shown(-outcome.curvature_ratio, 3) + " of the largest curvature, was met" + after +
               ": A is not positive definite";
    case Status::indefinite_preconditioner:
        return "r.M^-1 r was not positive" + after + ", at " + where +
               ": the preconditioner is not positive definite";
    case Status::non_finite:
        return "a value that is not finite appeared" + after + "; the last finite iterate has " + where;
    case Status::stagnated: return stagnation(report, outcome, where, after);
    case Status::zero_right_hand_side: return "b is zero, so x is zero";
    default:
        return std::to_string(report.iterations) + " iterations were allowed and " + where +
               " is above the tolerance of " + shown(options.tolerance, 3);
    }
}

} // namespace taut::linear
