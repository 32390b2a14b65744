#pragma once
// The pictures of a run, from snapshots that the run keeps.

#include "taut/scene/scene.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

struct Snapshot
{
    double time = 0;                   ///< s
    std::vector<glm::dvec3> positions; ///< m, in the order of the scene
};

/// Frames worth a snapshot for the contact sheet: spread evenly, first and last among them.
std::vector<std::uint64_t> snapshot_frames(std::uint64_t frames);

/// Writes picture.png (the last snapshot) and contact_sheet.png (all of them) into the folder and
/// returns their names. Without a device that draws: a warning that says why, and no names. Throws Error{io}.
std::vector<std::string> draw_pictures(const Scene& resolved, const std::vector<Snapshot>& snapshots,
                                       const std::filesystem::path& folder);

} // namespace taut::cli
