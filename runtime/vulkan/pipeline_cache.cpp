#include "taut/runtime/vulkan/pipeline_cache.hpp"

#include "taut/runtime/base/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace taut::vulkan {
namespace {

constexpr std::array<char, 8> kMagic = {'T', 'A', 'U', 'T', 'P', 'I', 'P', 'E'};
constexpr std::uint32_t kVersion = 1;

struct Header
{
    std::array<char, 8> magic = kMagic;
    std::uint32_t version = kVersion;
    std::uint32_t vendor = 0;
    std::uint32_t device = 0;
    std::uint32_t driver_version = 0;
    std::array<std::uint8_t, VK_UUID_SIZE> cache_uuid = {};
    std::uint64_t bytes = 0;
    std::uint64_t hash = 0;
};
static_assert(sizeof(Header) == 56, "written to a file as it is: no padding");

/// FNV-1a.
std::uint64_t hash_of(std::span<const std::byte> bytes)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const std::byte b : bytes)
        hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3u;
    return hash;
}

Header header_for(const VkPhysicalDeviceProperties& device, std::span<const std::byte> contents)
{
    Header header;
    header.vendor = device.vendorID;
    header.device = device.deviceID;
    header.driver_version = device.driverVersion;
    std::copy_n(device.pipelineCacheUUID, VK_UUID_SIZE, header.cache_uuid.begin());
    header.bytes = contents.size();
    header.hash = hash_of(contents);
    return header;
}

} // namespace

bool is_pipeline_cache(const std::string& path)
{
    if (!is_free_for_file(path))
        return false;
    std::ifstream file(path, std::ios::binary);
    std::array<char, kMagic.size()> found;
    file.read(found.data(), found.size());
    return std::equal(found.begin(), found.begin() + file.gcount(), kMagic.begin());
}

std::vector<std::byte> load_pipeline_cache(const std::string& path, const VkPhysicalDeviceProperties& device)
{
    constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;
    if (!is_free_for_file(path))
        return {};
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file)
        return {};
    const auto size = static_cast<std::int64_t>(file.tellg());
    if (size < static_cast<std::int64_t>(sizeof(Header)) || size > kMostBytes)
        return {};
    Header found;
    std::vector<std::byte> contents(static_cast<std::size_t>(size) - sizeof(Header));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(&found), sizeof(Header));
    file.read(reinterpret_cast<char*>(contents.data()), static_cast<std::streamsize>(contents.size()));
    if (!file)
        return {};
    const Header expected = header_for(device, contents);
    if (std::memcmp(&found, &expected, sizeof(Header)) != 0)
        return {};
    return contents;
}

bool save_pipeline_cache(const std::string& path, const VkPhysicalDeviceProperties& device,
                         std::span<const std::byte> contents) noexcept
{
    try
    {
        if (!is_pipeline_cache(path)) // also of what came there since the device was opened
            return false;
        const Header header = header_for(device, contents);
        std::string text(sizeof(Header) + contents.size(), '\0');
        std::memcpy(text.data(), &header, sizeof(Header));
        std::copy_n(reinterpret_cast<const char*>(contents.data()), contents.size(),
                    text.data() + sizeof(Header));
        write_file(path, text);
        return true;
    }
    catch (...)
    {}
    return false;
}

} // namespace taut::vulkan
