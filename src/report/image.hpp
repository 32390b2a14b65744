#pragma once
// Images as values: placing one in another, small labels, PNG files.

#include "taut/runtime/vulkan/draw.hpp"

#include <filesystem>
#include <string_view>

namespace taut {

/// One colour, opaque.
Image make_image(std::uint32_t width, std::uint32_t height, const glm::u8vec3& colour);

/// Copies `part` so that its top left pixel is at (x, y); what lies outside is cut off.
void place(Image& image, const Image& part, std::uint32_t x, std::uint32_t y);

/// Writes with the font of stb_easy_font; what is not ASCII is left blank. `size`: pixels of the image per
/// pixel of the font, whose capitals are 7 high.
void label(Image& image, std::string_view text, std::uint32_t x, std::uint32_t y, std::uint32_t size,
           const glm::u8vec3& colour);

/// Written to a temporary name, then renamed. Throws Error{io}.
void write_png(const std::filesystem::path& file, const Image& image);

} // namespace taut
