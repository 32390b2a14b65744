#pragma once
// Files of tetrahedra, written.

#include "taut/scene/mesh.hpp"

namespace taut {

/// Medit text (.mesh): vertices, tetrahedra, and the surface as triangles. Numbers read back as they are.
/// Written to a temporary name, then renamed. Throws Error{io}.
void write_medit(const std::filesystem::path& file, const Mesh& solid);

} // namespace taut
