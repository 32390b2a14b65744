#pragma once
// Internal to src/plan: contact with colliders and its friction, as effects (collider_shapes.hpp).

#include "taut/plan/faces.hpp"

namespace taut {

/// One for each ColliderKind, in order.
std::span<const Effect, kColliderKinds> collider_effects();

/// Whether the scene has a vertex.
bool has_bodies(const Scene& scene);
/// Whether any collider rubs.
bool wants_friction(const Scene& scene);
/// Turns the contact passes' friction on. Where colliders push once a substep, what friction took so far is
/// zero and needs no buffer.
void prepare_friction(PlanBuilder& b);

/// The passes of all colliders of the scene, beside those of Stage::contact.
void record_colliders(PlanBuilder& builder, const Moment& moment, const ColliderPush& push);

} // namespace taut
