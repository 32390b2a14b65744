#pragma once
// Internal to src/world: cloth that comes apart where it is stretched beyond Material::tear_strain.

#include "taut/scene/scene.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// A scene after a tear. Vertices that were there keep their number in their body, new ones follow them.
struct TornScene
{
    Scene scene;
    std::vector<std::uint32_t> origin; ///< of each scene-wide vertex: the one that it was part of before
    std::uint64_t splits = 0;          ///< vertices that came apart
};

/// Comes apart at one end of each spring that is longer than it bears at the positions x (scene-wide, m), the
/// longest first, no vertex and no neighbour of one twice. A mesh that is a manifold stays one; no triangle
/// is lost; the parts of a vertex share its mass by their area at rest. Held vertices are not torn from
/// their place: where one comes apart all its parts are held.
TornScene tear(const Scene& resolved, std::span<const glm::dvec3> x);

} // namespace taut
