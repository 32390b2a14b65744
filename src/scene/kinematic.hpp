#pragma once
// Bodies whose vertices are all led. Internal to src/scene.

#include "taut/scene/scene.hpp"

#include <filesystem>

namespace taut::scene_file {

/// Makes a body with a mesh kinematic: one pin of all vertices, places of its sequence if it has one, a
/// material without elements; a solid keeps its surface alone. Throws Error{io} and Error{bad_input} naming
/// the file of the sequence and what is wrong with it; nothing has changed then.
void resolve_kinematic(Body& body, const std::filesystem::path& directory);

} // namespace taut::scene_file
