#pragma once
// Internal to src/plan: the state of a scene and the passes that move it.

#include "taut/plan/builder.hpp"

namespace taut {

void prepare_motion(PlanBuilder& builder);
/// Whether the velocity at a step needs a pass of its own: forces act before the guess of a method whose
/// velocities stand before the step. Others kick after the displacement, and are asked for what follows it.
bool wants_coast(const Scene& scene);
void record_coast(PlanBuilder& builder, const Moment& moment);
void record_predict(PlanBuilder& builder, const Moment& moment);
void record_finish(PlanBuilder& builder, const Moment& moment);

} // namespace taut
