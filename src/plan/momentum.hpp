#pragma once
// Internal to src/plan: solids that nothing holds keep their angular momentum under methods that correct a
// guess of the places. docs/effects/momentum.md.

#include "taut/plan/builder.hpp"

namespace taut {

/// Whether a solid of the scene can turn freely: nothing of it is held, it meets neither others nor itself,
/// and there are no colliders (xpbd: or it starts out of shape).
bool wants_momentum(const Scene& scene);
void prepare_momentum(PlanBuilder& builder);
/// Before the sweeps of an iteration, where contacts follow each: what they begin from is kept.
void record_momentum_start(PlanBuilder& builder, const Moment& moment);
/// After them: what they took of the angular momentum comes back as a velocity.
void record_momentum_end(PlanBuilder& builder, const Moment& moment);

} // namespace taut
