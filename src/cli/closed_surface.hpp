#pragma once
// Files of surfaces that enclose a volume, for commands that fill it.

#include "taut/scene/mesh.hpp"

#include <string>

namespace taut::cli {

/// OBJ, PLY, OFF or STL, in the file's unit; its triangles come back counter-clockwise as seen from outside,
/// and what they enclose in `volume`. Throws Error{io}, and Error{bad_input} where it is not closed or
/// encloses nothing.
Mesh read_closed_surface(const std::string& file, double& volume);

} // namespace taut::cli
