#pragma once
// Checks an object of a scene as its table says.

#include "taut/scene/checker.hpp"
#include "taut/scene/descriptor.hpp"

namespace taut::scene_file {

/// Words and ranges of every key, and what the table's own check finds, of `object` and what it holds.
/// `object` is of the table's struct.
void check_table(const Table& table, const void* object, const Checker& out);

/// As check(), but each key by itself. Of a scene of which a part could not be read and is as by default.
std::vector<SceneIssue> check_keys(const Scene& scene);

} // namespace taut::scene_file
