#pragma once
// Real data that tests read where it lies: the folder that TAUT_DATA names, else ../shared/data beside the
// source tree. What needs it skips, visibly, where it is not.

#include "support/skip.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace taut {

inline std::filesystem::path data_folder()
{
    const char* named = std::getenv("TAUT_DATA");
    return named && *named ? std::filesystem::path(named)
                           : std::filesystem::path(TAUT_SOURCE_DIR) / "../shared/data";
}

/// The path of a file of the data; says so where it is missing (skip.hpp).
inline std::optional<std::filesystem::path> find_data(const std::string& file)
{
    const std::filesystem::path path = data_folder() / file;
    if (std::filesystem::exists(path))
        return path;
    left_out(path.string() + " is not there; set TAUT_DATA to the folder of shared data");
    return {};
}

} // namespace taut
