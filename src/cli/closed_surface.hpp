#pragma once
// Files of surfaces that enclose a volume, for commands that fill it.

#include "taut/scene/mesh.hpp"

#include <string>
#include <vector>

namespace taut::cli {

struct ClosedSurface
{
    Mesh mesh;                         ///< in the file's unit, counter-clockwise as seen from outside
    double volume = 0;                 ///< what it encloses, in the cube of that unit
    std::vector<std::string> messages; ///< what was warned of
};

/// OBJ, PLY, OFF or STL. Warns of lines that are not read, also of a file that is then refused: they may say
/// why it is open. Throws Error{io}, and Error{bad_input} where it is not closed or encloses nothing.
ClosedSurface read_closed_surface(const std::string& file);

} // namespace taut::cli
