#pragma once
// Internal to src/plan: the effect surface_volume (docs/effects/surface_volume.md).

#include "taut/plan/builder.hpp"

namespace taut {

/// Whether any body holds the volume within its surface.
bool any_surface_volume(const Scene& resolved);

/// Throws Error{limit} where more triangles meet at a vertex than one invocation may loop over.
void prepare_surface_volume(PlanBuilder& builder);
void record_surface_volume(PlanBuilder& builder, const Moment& moment);

/// Vertices of a group, a multiple of TAUT_LINEAR_GROUP: few enough to share the work, enough that no surface
/// has more than a thousand groups, since each of them adds up the sums of all.
std::uint32_t surface_chunk(std::uint32_t vertices);

} // namespace taut
