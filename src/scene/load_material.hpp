#pragma once
// Internal to src/scene: the material of a body.

#include "taut/scene/field.hpp"
#include "taut/scene/scene.hpp"

namespace taut::scene_file {

/// Reads the keys that are there into `material`, which has the defaults; `solid`: of a body with tetrahedra.
void read_material(Field field, bool solid, Material& material);

} // namespace taut::scene_file
