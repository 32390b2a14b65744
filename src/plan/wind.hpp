#pragma once
// Internal to src/plan: air on triangles.

#include "taut/plan/builder.hpp"

namespace taut {

bool catches_air(const Body& body);
/// Air with a density, and a body of triangles that it takes hold of.
bool wants_wind(const Scene& scene);
void prepare_wind(PlanBuilder& builder);
void record_wind(PlanBuilder& builder, const Moment& moment);

} // namespace taut
