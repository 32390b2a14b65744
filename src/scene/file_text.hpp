#pragma once
// Whole files to memory, with errors that name the file.

#include <cstdint>
#include <filesystem>
#include <string>

namespace taut::scene_file {

/// Throws Error{io} if the file is missing, no regular file or unreadable, Error{bad_input} if it is
/// larger than `max_bytes`.
std::string read_file(const std::filesystem::path& file, std::uintmax_t max_bytes);

inline constexpr std::uintmax_t kMaxSceneBytes = std::uintmax_t(1) << 28; ///< of a scene file

} // namespace taut::scene_file
