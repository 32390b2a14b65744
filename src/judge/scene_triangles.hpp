#pragma once
// The triangles of all bodies of a scene, as a judge numbers them.

#include "taut/judge/surface.hpp"
#include "taut/scene/scene.hpp"

namespace taut::judging {

struct SceneTriangles
{
    std::vector<Triangle> triangles; ///< vertices scene-wide: bodies one after another, as World::positions()
    std::vector<std::uint32_t> body; ///< per vertex
    std::vector<bool> led;           ///< per vertex: of a kinematic body
    PassingBodies passing;           ///< by the groups of the bodies; empty where none passes through another
};

/// Of a resolved scene. Solids give their surfaces; chains have none.
SceneTriangles scene_triangles(const Scene& resolved);

} // namespace taut::judging
