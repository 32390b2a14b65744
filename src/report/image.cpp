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
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace taut {
namespace {

struct Glyph
{
    char letter;
    std::array<std::uint8_t, 7> rows; ///< five bits each, the leftmost pixel is 16
};

constexpr Glyph kFont[] = {
    {'0', {14, 17, 17, 17, 17, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},  {'2', {14, 17, 1, 2, 4, 8, 31}},
    {'3', {14, 17, 1, 6, 1, 17, 14}},    {'4', {2, 6, 10, 18, 31, 2, 2}}, {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {14, 16, 30, 17, 17, 17, 14}}, {'7', {31, 1, 2, 4, 4, 8, 8}},   {'8', {14, 17, 17, 14, 17, 17, 14}},
    {'9', {14, 17, 17, 17, 15, 1, 14}},  {'.', {0, 0, 0, 0, 0, 12, 12}},  {'=', {0, 0, 31, 0, 31, 0, 0}},
    {'-', {0, 0, 0, 31, 0, 0, 0}},       {'t', {8, 8, 28, 8, 8, 9, 6}},   {'s', {0, 0, 15, 16, 14, 1, 30}},
};

std::uint8_t* pixel(Image& image, std::uint32_t x, std::uint32_t y)
{
    return image.rgba.data() + 4 * (std::size_t(y) * image.width + x);
}

void fill(Image& image, std::uint32_t x, std::uint32_t y, std::uint32_t size, const glm::u8vec3& colour)
{
    for (std::uint32_t v = y; v < std::min(y + size, image.height); ++v)
        for (std::uint32_t u = x; u < std::min(x + size, image.width); ++u)
            for (int c = 0; c < 3; ++c)
                pixel(image, u, v)[c] = colour[c];
}

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
    for (const char letter : text)
    {
        const auto glyph = std::find_if(std::begin(kFont), std::end(kFont),
                                        [&](const Glyph& g) { return g.letter == letter; });
        for (std::uint32_t row = 0; glyph != std::end(kFont) && row < 7; ++row)
            for (std::uint32_t column = 0; column < 5; ++column)
                if ((glyph->rows[row] >> (4 - column) & 1) != 0)
                    fill(image, x + column * size, y + row * size, size, colour);
        x += (letter == '.' ? 5 : 6) * size;
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
