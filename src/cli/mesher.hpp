#pragma once
// Programs that fill a surface with tetrahedra. They are used as programs only: their licences (AGPL, GPL)
// stay outside of Taut.

#include "taut/scene/mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace taut::cli {

struct Mesher
{
    std::string name; ///< also that of the program
    /// Writes what the program reads into the folder; returns its arguments. `max_volume` of a tetrahedron,
    /// in the cube of the surface's unit; 0: none.
    std::vector<std::string> (*prepare)(const std::filesystem::path& folder, const Mesh& surface,
                                        double max_volume);
    const char* result; ///< the file that the program leaves in the folder
};

/// In the order in which they are tried.
const std::vector<Mesher>& meshers();

} // namespace taut::cli
