#pragma once
// Whether this machine has the memory that generated bodies take.

#include "taut/scene/scene.hpp"

#include <cstdint>

namespace taut::scene_file {

/// Bytes that this process may have: of the machine, or of the control group that it runs in; 0 if unknown.
std::uint64_t host_memory();

/// Throws Error{out_of_memory} where the vertices of generated bodies alone, with what is known of them while
/// a scene is resolved and planned, take more than `memory` bytes. Bodies of files are read, however many
/// they have, and kinematic ones made. Nothing is refused if `memory` is 0.
void check_room(const Scene& scene, std::uint64_t memory);

} // namespace taut::scene_file
