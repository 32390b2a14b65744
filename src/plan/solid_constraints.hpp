#pragma once
// Internal to src/plan: tetrahedra of all bodies, as coloured constraints of XPBD and as lists.

#include "taut/plan/builder.hpp"
#include "taut/plan/solid.hpp"

namespace taut {

/// Tetrahedra of a body with a corner that moves, in plan vertices.
std::vector<VolumeElement> acting_volumes(const PlanBuilder& builder, std::size_t body);
std::vector<SolidElement> acting_solids(const PlanBuilder& builder, std::size_t body);

/// Those of all bodies, body by body: elastic ones and, as elements without shear stiffness, held volumes.
std::vector<SolidElement> all_solids(const PlanBuilder& builder);

void prepare_volume(PlanBuilder& builder);
void record_volume(PlanBuilder& builder, const Moment& moment);
void prepare_neo_hookean(PlanBuilder& builder);
void record_neo_hookean(PlanBuilder& builder, const Moment& moment);

} // namespace taut
