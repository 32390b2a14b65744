#pragma once
// How deep the vertices of bodies lie within colliders: at the start, of which `taut check` warns, and where
// a run ends, by which it is judged.

#include "taut/report/soundness.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace taut {

/// How deep a body lies in a collider, by the vertices that no pin holds.
struct DeepVertex
{
    std::size_t body = 0, collider = 0;
    double depth = 0;       ///< m below the surface, of the deepest, > 0
    double roomy = 0;       ///< m: the same of those that no other collider holds, too
    std::size_t vertex = 0; ///< of the body: the one of `roomy`
    double size = 0;        ///< m: diagonal of the box that the body fills at rest; of one vertex, the scene
    double rounding = 0;    ///< m: how far off float may place a collider there
};

/// Of every body and collider that have one, at places `x` (m, scene-wide) and `time` (s). Linear in vertices
/// times colliders.
std::vector<DeepVertex> deep_vertices(const Scene& resolved, std::span<const glm::dvec3> x, double time);

/// Of a body's size: deeper than that, and than rounding, is no error of a step, but a body that lies within
/// a collider.
inline constexpr double kDeepShare = 0.01;

/// `unconverged` where a vertex is deeper than kDeepShare in one collider, and in or at no other: two may
/// leave it no room.
Soundness judge_depth(const Scene& resolved, std::span<const DeepVertex> deep);

/// A warning for each body that starts deeper in a collider than that, with the speed at which it is let out.
std::vector<SceneIssue> deep_start_issues(const Scene& resolved);

} // namespace taut
