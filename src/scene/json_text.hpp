#pragma once
// JSON text to a tree, strictly: duplicate keys, deep nesting and broken text are errors that say where.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace taut::scene_file {

/// Throws Error{bad_input} naming `file`, and line and column of the fault.
nlohmann::json parse_json(std::string_view text, const std::string& file);

/// The keys of an object in an object, in alphabetical order; none where either is none.
std::vector<std::string> keys_of(const nlohmann::json& tree, const char* name);

} // namespace taut::scene_file
