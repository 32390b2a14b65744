#pragma once
// The text of OBJ files, for single meshes and for the meshes of a run.

#include "taut/scene/mesh.hpp"

#include <span>
#include <string>
#include <string_view>

namespace taut::scene_file {

/// Digits that give back every float, and every double.
inline constexpr int kFloatDigits = 9, kDoubleDigits = 17;

/// A number as printf("%.*g") in the "C" locale.
void append_number(std::string& text, double value, int digits = kFloatDigits);

/// A line "v x y z" each, m.
void append_vertices(std::string& text, std::span<const glm::dvec3> positions, int digits = kFloatDigits);

/// A line "f a b c" for each triangle, then a line "l a b" for each link. `first` vertices stand in the
/// file before the first one of the mesh.
void append_elements(std::string& text, const Mesh& mesh, std::size_t first);

} // namespace taut::scene_file
