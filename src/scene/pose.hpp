#pragma once
// What pose() of scene.hpp is made of. Internal.

#include "taut/scene/scene.hpp"

namespace taut {

/// rad: the axis times the angle of a key, which pose() takes to be linear between keys; 0 without an axis.
glm::dvec3 rotation_of(const Keyframe& key);

} // namespace taut
