#pragma once
// Internal to src/plan: triangles against colliders, a part of each shape's effect (scene/faces.hpp says
// which).

#include "taut/plan/builder.hpp"

namespace taut {

/// Adds nothing where no triangle meets a collider of that kind. Throws Error{limit} where too many triangles
/// meet at one vertex.
void prepare_faces(PlanBuilder& builder, ColliderKind kind);
/// The passes, after that over the vertices.
void record_faces(PlanBuilder& builder, const Moment& moment, ColliderKind kind);

} // namespace taut
