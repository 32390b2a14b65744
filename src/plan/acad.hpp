#pragma once
// Internal to src/plan: springs that become constraints beyond a strain, and springs again
// (docs/methods/acad.md).

#include "taut/plan/implicit_constraints.hpp"

namespace taut {

class Refusals;

/// What the method keeps while a plan is made.
struct Acad
{
    std::vector<StretchElement> elements; ///< springs of all bodies that can act, in plan vertices
    Incidence at;
    ConstraintRows rows; ///< of the constraints of the substep, side by side
    std::uint32_t groups = 1, chunk = 0;
    bool damped = false;
    // Per spring end, and per spring.
    std::uint32_t ends = kNoBuffer, springs = kNoBuffer, candidates = kNoBuffer;
    std::uint32_t hold = kNoBuffer, flags = kNoBuffer, multiplier = kNoBuffer;
    // Of the prefix sum.
    std::uint32_t sums = kNoBuffer, control = kNoBuffer, row_list = kNoBuffer, touched = kNoBuffer;
    std::uint32_t total = kNoBuffer; ///< real a row; with more than one solve a substep
    std::optional<PlanSolve> solve;
};

void check_acad(const Scene& resolved, Refusals& out);

void prepare_acad(PlanBuilder& builder);
/// Forces of the springs, and which of them are constraints in this substep.
void record_acad_forces(PlanBuilder& builder, const Moment& moment);
void record_acad_solve(PlanBuilder& builder, const Moment& moment);

} // namespace taut
