#pragma once
// What the tests of images and pictures share: pixels, PNG files read back, refusals, a folder.

#include "support/catch.hpp"

#include "taut/runtime/vulkan/draw.hpp"

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>

namespace taut::test {

inline glm::ivec3 pixel(const Image& image, std::uint32_t x, std::uint32_t y)
{
    const std::uint8_t* p = image.rgba.data() + 4 * (std::size_t(y) * image.width + x);
    return {p[0], p[1], p[2]};
}

inline std::size_t differing(const Image& a, const Image& b)
{
    REQUIRE(a.rgba.size() == b.rgba.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        count += std::equal(a.rgba.begin() + static_cast<std::ptrdiff_t>(i),
                            a.rgba.begin() + static_cast<std::ptrdiff_t>(i + 4),
                            b.rgba.begin() + static_cast<std::ptrdiff_t>(i))
                     ? 0
                     : 1;
    return count;
}

template <typename Act>
void check_refusal(ErrorCode code, const Act& act)
{
    try
    {
        act();
        FAIL("nothing was thrown");
    }
    catch (const Error& error)
    {
        INFO(error.what());
        CHECK(to_string(error.code()) == to_string(code));
    }
}

/// A folder that lives as long as the test.
struct Folder
{
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("taut-picture-" + std::to_string(std::random_device{}()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

Image read_png(const std::filesystem::path& file); ///< image_test.cpp

} // namespace taut::test
