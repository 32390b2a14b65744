#pragma once
// Single values of a scene file set from outside: "method.substeps=20", "bodies[0].material.drag=1".

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace taut::scene_file {

/// Sets one value in the tree of a scene file. What stands after "=" is JSON, or else a text as it is
/// ("method.type=acad"). Objects on the way are made where they are missing, lists never. Throws
/// Error{bad_input} naming `file`, the setting and what would be right; keys are checked by the parser.
void set_value(nlohmann::json& tree, std::string_view setting, const std::string& file);

} // namespace taut::scene_file
