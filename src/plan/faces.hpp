#pragma once
// Internal to src/plan: triangles against colliders, a part of each shape's effect (scene/faces.hpp says
// which).

#include "taut/plan/builder.hpp"

namespace taut {

/// Sweeps over triangles each time that colliders push, where no other push follows: means of pushes that
/// were found at once are less than what each triangle needs. docs/contact.md, "Colliders and triangles", has
/// what fewer and more of them leave.
inline constexpr std::uint32_t kFaceSweeps = 4;

/// One of the times in a substep that colliders push.
struct ColliderPush
{
    bool first = true;   ///< in its substep: friction has taken nothing yet
    bool report = false; ///< count held vertices below a surface
    std::uint32_t face_sweeps = kFaceSweeps;
};

/// Adds nothing where no triangle meets a collider of that kind. Throws Error{limit} where too many triangles
/// meet at one vertex.
void prepare_faces(PlanBuilder& builder, ColliderKind kind);
/// The passes, after that over the vertices.
void record_faces(PlanBuilder& builder, const Moment& moment, const ColliderPush& push, ColliderKind kind);

} // namespace taut
