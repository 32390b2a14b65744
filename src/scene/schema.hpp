#pragma once
// The scene format as a JSON Schema and as the tables of the pages, both from the tables of keys.

#include <nlohmann/json.hpp>

#include <string>

namespace taut::scene_file {

/// A JSON Schema (draft 2020-12): types, ranges, words, defaults, and what each key is. Every scene that
/// loads and passes check() is valid by it. It cannot say what takes two keys or a file, so the reverse does
/// not hold.
nlohmann::ordered_json scene_schema();

/// The tables of docs/scene.md and docs/methods.md, each after the line "<!-- NAME -->" and before
/// "<!-- end -->", as the pages have them.
std::string tables_as_markdown();

} // namespace taut::scene_file
