#include "images.hpp"

#include "taut/report/image.hpp"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

#include <fstream>

using namespace taut;
using namespace taut::test;

Image taut::test::read_png(const std::filesystem::path& file)
{
    int width = 0, height = 0, channels = 0;
    std::uint8_t* data = stbi_load(file.c_str(), &width, &height, &channels, 4);
    REQUIRE(data != nullptr);
    Image out = {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), {}};
    out.rgba.assign(data, data + std::size_t(4) * out.width * out.height);
    stbi_image_free(data);
    return out;
}

TEST_CASE("a PNG file holds the very pixels, with signature and size")
{
    Folder folder;
    Image image = make_image(7, 3, {10, 20, 30});
    for (std::size_t i = 0; i < image.rgba.size(); ++i)
        if (i % 4 != 3)
            image.rgba[i] = static_cast<std::uint8_t>(37 * i);
    write_png(folder.path / "a.png", image);
    std::ifstream file(folder.path / "a.png", std::ios::binary);
    std::string head(24, '\0');
    file.read(head.data(), 24);
    CHECK(head == std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x07\0\0\0\x03", 24));
    const Image back = read_png(folder.path / "a.png");
    CHECK(back.width == 7);
    CHECK(back.rgba == image.rgba);
    check_refusal(ErrorCode::io, [&] { write_png(folder.path / "missing" / "a.png", image); });
}

TEST_CASE("a label changes pixels where it stands, and what does not fit is cut off")
{
    const Image plain = make_image(60, 20, {255, 255, 255});
    Image image = plain;
    label(image, "-", 2, 3, 1, {0, 0, 0}); // one bar: the third row of seven below the top
    const std::size_t bar = differing(image, plain);
    CHECK(bar >= 3);
    CHECK(bar <= 6);
    Image large = plain;
    label(large, "-", 2, 3, 2, {0, 0, 0});
    CHECK(differing(large, plain) == 4 * bar);
    label(large, "\xc3\xa4", 30, 3, 1, {0, 0, 0}); // not ASCII
    CHECK(differing(large, plain) == 4 * bar);
    label(image, "Every letter: (k = 5) 0.123456789", 40, 15, 2, {0, 0, 0});
    place(image, make_image(10, 10, {1, 2, 3}), 55, 12);
    CHECK(pixel(image, 59, 19) == glm::ivec3(1, 2, 3));
    CHECK(pixel(image, 0, 19) == glm::ivec3(255));
}
