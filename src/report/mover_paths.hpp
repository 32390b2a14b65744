#pragma once
// The ways of pins and colliders that keyframes and sequences lead.

#include "taut/scene/scene.hpp"
#include "taut/world/mover.hpp"

#include <memory>
#include <vector>

namespace taut {

/// Pins that move, or a collider that does.
struct MoverPath
{
    bool holds = false;            ///< pins: they move a body wherever it is; not of kinematic bodies
    std::vector<MoverReach> reach; ///< ascending in time
};

/// Of all pins of the bodies of a resolved scene, and of its kinematic bodies.
std::vector<MoverPath> pin_paths(const Scene& resolved);

/// Of the colliders of a scene that move by keyframes.
using ColliderPaths = std::shared_ptr<const std::vector<MoverPath>>;
/// Of a plane, the part that bodies can be at which fill a box of `diameter`, m.
ColliderPaths collider_paths(const Scene& resolved, double diameter);

} // namespace taut
