#pragma once
// Whether surfaces that are to meet go through each other where a scene starts.

#include "taut/scene/scene.hpp"

#include <string>

namespace taut {

/// A sentence that names how many pairs of triangles do, and the first of them with its bodies; empty where
/// none does, or none is to meet. Exact (judge/exact.hpp). `resolved`: by resolve().
std::string crossed_at_start(const Scene& resolved);

} // namespace taut
