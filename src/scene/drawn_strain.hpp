#pragma once
// How far pins draw a body apart.

#include "taut/scene/scene.hpp"

namespace taut {

/// The largest strain of a straight line between vertices of two pins of a resolved body, of the motions that
/// the scene knows; at most 0.5, or `tear_strain`. Flat material between them is strained by as much at
/// least; cloth with folds at rest may be strained by less. 0 where nothing draws.
double drawn_strain(const Body& resolved);

} // namespace taut
