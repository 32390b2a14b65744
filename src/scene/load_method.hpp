#pragma once
// The "method" and "accept" of a scene file. Internal.

#include "taut/scene/field.hpp"
#include "taut/scene/scene.hpp"

namespace taut::scene_file {

/// Keys that are missing leave `method` alone. Throws Error(bad_input) with the field's name.
void read_method(Field field, MethodSettings& method);

/// Throws Error(bad_input) with the field's name.
Accept read_accept(Field field);

} // namespace taut::scene_file
