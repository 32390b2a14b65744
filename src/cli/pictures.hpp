#pragma once
// The pictures of a run, from moments that the run keeps.

#include "taut/report/picture.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace taut::cli {

/// Frames worth a place on the contact sheet: spread evenly, first and last among them.
std::vector<std::uint64_t> moment_frames(std::uint64_t frames);

/// Writes picture.png (the world as it is, from its own buffer where its device draws) and contact_sheet.png
/// (all moments) into the folder and returns their names. Nothing is written where no device can draw:
/// `why_not` then says why. Throws Error{io}.
std::vector<std::string> draw_pictures(const World& world, std::shared_ptr<Device> device,
                                       const std::vector<PictureMoment>& moments,
                                       const std::filesystem::path& folder, std::string& why_not);

} // namespace taut::cli
