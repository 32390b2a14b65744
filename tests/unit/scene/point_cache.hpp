#pragma once
// The bytes of a PC2 file: what its head says, and then `values`, whether they fit or not.

#include <cstdint>
#include <string>
#include <vector>

inline std::string point_cache(std::uint32_t points, std::uint32_t samples, const std::vector<float>& values,
                               std::uint32_t version = 1)
{
    std::string text("POINTCACHE2\0", 12);
    const auto add = [&](const auto& value) {
        text.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    add(version);
    add(points);
    add(0.0f);
    add(1.0f);
    add(samples);
    for (const float value : values)
        add(value);
    return text;
}
