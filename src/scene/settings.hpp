#pragma once
// Scene files with single values set from outside, for variants of one scene.

#include "taut/scene/scene.hpp"

#include <span>
#include <string>
#include <vector>

namespace taut {

/// As load_scene and parse_scene of scene.hpp; `settings` change single values before anything is checked:
/// "method.type=acad", "bodies[0].material.drag=1". Throws Error{bad_input} for one that names nothing.
Scene load_scene(const std::filesystem::path& file, std::span<const std::string> settings);
Scene parse_scene(std::string_view json, const std::filesystem::path& directory, std::string_view name,
                  std::span<const std::string> settings);

/// load_scene() and resolve() in one; what resolve() throws then names the file as well as the field.
Scene resolve_file(const std::filesystem::path& file, std::span<const std::string> settings,
                   std::vector<SceneIssue>* found = nullptr);

/// All that is wrong with a scene file: every key that cannot be read, and what check() says; where there is
/// such a key, check() looks at each of the others by itself. Throws Error{io} where the file cannot be read,
/// Error{bad_input} where it is not JSON. The file is parsed once: `scene` becomes what load_scene() returns
/// where there is no error, `method_keys` what given_method_keys() does.
std::vector<SceneIssue> check_file(const std::filesystem::path& file, Scene* scene = nullptr,
                                   std::vector<std::string>* method_keys = nullptr);

/// Whether one of them is an error, not a warning.
bool any_error(std::span<const SceneIssue> issues);

/// The keys of `method` in a scene file and in `settings`, in alphabetical order; empty without a
/// method. Throws as load_scene does where the file cannot be read as an object.
std::vector<std::string> given_method_keys(const std::filesystem::path& file,
                                           std::span<const std::string> settings);

} // namespace taut
