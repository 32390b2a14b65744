#pragma once
// Which vertices colliders hold: their forces are on no record, since contacts push after the solve.

#include "taut/report/model.hpp"
#include "taut/scene/scene.hpp"

#include <span>
#include <vector>

namespace taut {

/// Of each vertex whether it, or a triangle of it that meets colliders (scene/faces.hpp), is no further than
/// its way from where a collider holds it. `scene`: resolved, of the model's bodies; `x` in m, scene-wide, at
/// `time` in s. `ways`: m, by vertex; empty: 0.
std::vector<bool> touching_colliders(const Scene& scene, const PhysicalModel& model,
                                     std::span<const glm::dvec3> x, double time,
                                     std::span<const double> ways = {});

} // namespace taut
