#pragma once
// Internal to src/plan: the effect plasticity (docs/effects/plasticity.md).

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Buffers of the effect while a plan is made; kNoBuffer and 0 where a scene has no use for them.
struct Plasticity
{
    std::uint32_t springs = 0;             ///< records that can flow
    bool forces = false;                   ///< they are layout::Spring, not layout::DistanceConstraint
    std::uint32_t spring_records = kNoBuffer, spring_list = kNoBuffer, spring_rules = kNoBuffer;
    std::uint32_t solids = 0; ///< tetrahedra that can flow
    std::uint32_t solid_records = kNoBuffer, solid_table = kNoBuffer, solid_rules = kNoBuffer,
                  solid_state = kNoBuffer;
};

/// Whether any body has springs or elastic tetrahedra that keep strain.
bool wants_plasticity(const Scene& resolved);

/// Refuses, as `unsupported`, bodies that would, under methods that have no such thing, or in a scene in
/// which cloth can tear.
void check_plasticity(const Scene& resolved, Refusals& out);

/// After the effects that own the records: changes those of plastic bodies in place from then on. They and
/// what has flowed become part of a world's state (Plan::kept).
void prepare_plasticity(PlanBuilder& builder);
void record_plasticity(PlanBuilder& builder, const Moment& moment);

} // namespace taut
