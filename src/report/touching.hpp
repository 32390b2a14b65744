#pragma once
// Which vertices colliders hold: their forces are on no record, since contacts push after the solve.

#include "taut/report/model.hpp"
#include "taut/scene/scene.hpp"

#include <span>
#include <vector>

namespace taut {

/// Of each vertex whether it, or a triangle of it that meets colliders (scene/faces.hpp), is no further than
/// its gap and its share of `ways` [m, by vertex; empty: 0] from where one of `colliders` holds it. `scene`:
/// resolved, of the model's bodies; `x` in m, scene-wide, at `time` in s.
std::vector<bool> touching_colliders(const Scene& scene, std::span<const Collider> colliders,
                                     const PhysicalModel& model, std::span<const glm::dvec3> x, double time,
                                     std::span<const double> ways = {});

} // namespace taut
