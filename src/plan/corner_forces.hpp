#pragma once
// Internal to src/plan: elements as forces, a slot a corner, for methods that step explicitly: hinges, and
// kinds that the program has added.

#include "taut/plan/builder.hpp"

namespace taut {

void prepare_hinge_force(PlanBuilder& builder);
void record_hinge_force(PlanBuilder& builder, const Moment& moment);
/// The same after the guess.
void record_hinge_force_after(PlanBuilder& builder, const Moment& moment);

/// On account of each kind.
void prepare_added_forces(PlanBuilder& builder);
void record_added_forces(PlanBuilder& builder, const Moment& moment);
void record_added_forces_after(PlanBuilder& builder, const Moment& moment);

/// The sum at each vertex, after all kinds. Throws Error{limit} for a vertex of more corners than one
/// invocation may visit.
void prepare_corner_sum(PlanBuilder& builder);
void record_corner_sum(PlanBuilder& builder, const Moment& moment);

} // namespace taut
