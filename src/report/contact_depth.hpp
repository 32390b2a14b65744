#pragma once
// How near surfaces come to each other, in fp64 on the host.

#include "taut/world/world.hpp"

#include <span>
#include <vector>

namespace taut {

/// m: the distance of the two of a pair at the places x (scene-wide).
double distance_of(const SurfacePair& pair, std::span<const glm::dvec3> x);

/// m: by how much the nearest pair that is listed is nearer than it is kept; 0 where none is. Pairs that have
/// passed through each other count as near, not as deep.
double contact_depth(const World& world, std::span<const glm::dvec3> x);

/// Of each vertex, scene-wide, whether it is a corner of a pair that is listed.
std::vector<bool> in_contact(const World& world);

} // namespace taut
