#include "taut/report/image.hpp"

#include "taut/runtime/base/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <string>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_easy_font.h>
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace taut {
namespace {

std::uint8_t* pixel(Image& image, std::uint32_t x, std::uint32_t y)
{
    return image.rgba.data() + 4 * (std::size_t(y) * image.width + x);
}

void fill(Image& image, std::uint32_t left, std::uint32_t top, std::uint32_t right, std::uint32_t bottom,
          const glm::u8vec3& colour)
{
    for (std::uint32_t v = top; v < std::min(bottom, image.height); ++v)
        for (std::uint32_t u = left; u < std::min(right, image.width); ++u)
            for (int c = 0; c < 3; ++c)
                pixel(image, u, v)[c] = colour[c];
}

constexpr std::size_t kMostQuads = 24; ///< of a letter

/// As stb_easy_font.h lays it out.
struct FontVertex
{
    float x, y, z;
    std::array<std::uint8_t, 4> colour;
};

} // namespace

Image make_image(std::uint32_t width, std::uint32_t height, const glm::u8vec3& colour)
{
    Image image = {width, height, std::vector<std::uint8_t>(std::size_t(4) * width * height, 255)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (i % 4 < 3)
            image.rgba[i] = colour[static_cast<int>(i % 4)];
    return image;
}

void place(Image& image, const Image& part, std::uint32_t x, std::uint32_t y)
{
    if (x >= image.width)
        return;
    const std::size_t bytes = std::size_t(4) * std::min(part.width, image.width - x);
    for (std::uint32_t row = 0; row < part.height && y + row < image.height; ++row)
        std::copy_n(part.rgba.data() + std::size_t(4) * part.width * row, bytes, pixel(image, x, y + row));
}

void label(Image& image, std::string_view text, std::uint32_t x, std::uint32_t y, std::uint32_t size,
           const glm::u8vec3& colour)
{
    std::string ascii(text);
    for (char& letter : ascii)
        if (letter < ' ' || letter > '~')
            letter = ' ';
    std::vector<FontVertex> corners(ascii.size() * 4 * kMostQuads);
    const int quads = stb_easy_font_print(0, 0, ascii.data(), nullptr, corners.data(),
                                          static_cast<int>(corners.size() * sizeof(FontVertex)));
    const auto at = [size](std::uint32_t from, float units) {
        return from + static_cast<std::uint32_t>(units * static_cast<float>(size) + 0.5f);
    };
    for (std::size_t k = 0; k < 4 * static_cast<std::size_t>(quads); k += 4)
    {
        const FontVertex &from = corners[k], &to = corners[k + 2];
        fill(image, at(x, from.x), at(y, from.y), at(x, to.x), at(y, to.y), colour);
    }
}

void write_png(const std::filesystem::path& file, const Image& image)
{
    std::string png;
    const auto append = [](void* out, void* data, int bytes) {
        static_cast<std::string*>(out)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(bytes));
    };
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    if (stbi_write_png_to_func(append, &png, width, height, 4, image.rgba.data(), 4 * width) == 0)
        throw Error(ErrorCode::io, "cannot encode " + file.string() + " as PNG (" + std::to_string(width) +
                                       " x " + std::to_string(height) + " pixels)");
    write_file(file, png);
}

} // namespace taut
