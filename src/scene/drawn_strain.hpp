#pragma once
// How far pins draw a body apart.

#include "taut/scene/scene.hpp"

namespace taut {

/// The largest strain of a straight line between vertices of two pins of a resolved body, of the motions that
/// the scene knows: no material between them can be strained by less. 0 where nothing draws.
double drawn_strain(const Body& body);

} // namespace taut
