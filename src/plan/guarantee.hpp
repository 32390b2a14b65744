#pragma once
// Internal to src/plan: surfaces that never cross, as an effect (docs/contact.md, "The guarantee").

#include "taut/plan/builder.hpp"

namespace taut {

/// After prepare_contact.
void prepare_guarantee(PlanBuilder& builder);
/// Where vertices may be until the next search; behind each search.
void record_guarantee_anchor(PlanBuilder& builder, const Moment& moment);
/// Cuts the ways of vertices; nothing may move one behind it.
void record_guarantee(PlanBuilder& builder, const Moment& moment);

} // namespace taut
