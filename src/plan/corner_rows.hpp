#pragma once
// Internal to src/plan: rows of implicit constraints with four corners, tetrahedra that keep their volume and
// hinges that keep their angle.

#include "taut/plan/constraint_system.hpp"
#include "taut/plan/solve.hpp"

namespace taut {

/// Rows of four corners in their order: tetrahedra, then hinges. In plan vertices; compliance as a row.
struct CornerSet
{
    std::vector<VolumeElement> volumes;
    std::vector<BendElement> hinges; ///< compliance of the scaled row, m^2/J
    float scale = 1;                 ///< m: the row of a hinge is this times its angle
    std::vector<double> inverse;     ///< of each row's diagonal with the places at rest
    std::size_t size() const { return volumes.size() + hinges.size(); }
    std::vector<std::uint32_t> corners() const; ///< four a row
};

/// Each row has at least kRegularisation of what makes its diagonal as compliance: with the rows of their
/// edges tetrahedra and hinges are more rows than freedom. Adds the warning "degenerate" for hinges without
/// an angle at rest.
CornerSet corner_set(PlanBuilder& builder);
inline constexpr double kRegularisation = 1e-4;

/// Buffers of the set's rows. Throws Error{limit} where a vertex has more of them than one invocation may
/// loop over; `groups` are those of the whole system.
CornerRows add_corner_buffers(PlanBuilder& builder, std::string_view effect, const CornerSet& set,
                              std::uint32_t groups);

/// The passes that form the rows, those of springs before them. `multiplier`: kNoBuffer with one solve a
/// substep.
void record_corner_rows(PlanBuilder& builder, std::string_view effect, const CornerSet& set,
                        const ConstraintRows& rows, const PlanSolve& solve, std::uint32_t multiplier,
                        std::uint32_t groups, const Moment& moment);

} // namespace taut
