#pragma once
// Names of parts of generated shapes, by which pins hold them. Internal to src/scene.

#include <string_view>

namespace taut::scene_file {

inline constexpr std::string_view kGridCorners[] = {"top_left", "top_right", "bottom_left", "bottom_right"};
inline constexpr std::string_view kChainEnds[] = {"first", "last"};
inline constexpr std::string_view kGridEdges[] = {"top", "bottom", "left", "right"};
/// Along x, y and z.
inline constexpr std::string_view kBoxFaces[] = {"left", "right", "bottom", "top", "back", "front"};

} // namespace taut::scene_file
