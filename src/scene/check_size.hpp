#pragma once
// Whether the arithmetic of a run can hold a body of this size.

#include "taut/scene/checker.hpp"

namespace taut::scene_file {

/// An error where the square of a body's longest edge is beyond float (`twice`: double), a warning where that
/// of an area is and the body has volumes or bends. The body is resolved.
void check_size(const Body& body, bool twice, const Checker& out);

} // namespace taut::scene_file
