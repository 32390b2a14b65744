#include "taut/scene/solid_builder.hpp"

#include <algorithm>

namespace taut::scene_file {
namespace {

std::string numbers(const std::vector<std::pair<std::int64_t, std::uint32_t>>& sorted)
{
    if (sorted.empty())
        return "there is none";
    const std::int64_t first = sorted.front().first, last = sorted.back().first;
    // Without sign: the distance of any two numbers fits.
    const bool gaps =
        static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first) != sorted.size() - 1;
    return "there are " + std::to_string(sorted.size()) + ", numbered from " + std::to_string(first) +
           " to " + std::to_string(last) + (gaps ? " with gaps" : "");
}

} // namespace

void SolidBuilder::add_vertex(std::int64_t number, const glm::dvec3& position)
{
    index_of_.emplace_back(number, static_cast<std::uint32_t>(solid_.positions.size()));
    solid_.positions.push_back(position);
}

std::string SolidBuilder::close_vertices()
{
    closed_ = true;
    if (!std::is_sorted(index_of_.begin(), index_of_.end()))
        std::sort(index_of_.begin(), index_of_.end());
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    const auto twice = std::adjacent_find(index_of_.begin(), index_of_.end(), same);
    return twice == index_of_.end()
               ? ""
               : "two vertices have the number " + std::to_string(twice->first) + "; each must have its own";
}

std::string SolidBuilder::add_tetrahedron(std::int64_t number, const std::array<std::int64_t, 4>& corners)
{
    std::array<std::uint32_t, 4> indices{};
    for (std::size_t c = 0; c < 4; ++c)
    {
        const auto found =
            std::lower_bound(index_of_.begin(), index_of_.end(), corners[c],
                             [](const auto& entry, std::int64_t n) { return entry.first < n; });
        if (found == index_of_.end() || found->first != corners[c])
            return "tetrahedron " + std::to_string(number) + " names vertex " + std::to_string(corners[c]) +
                   "; " + numbers(index_of_);
        indices[c] = found->second;
    }
    std::array<std::uint32_t, 4> sorted = indices;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
        return "tetrahedron " + std::to_string(number) +
               " names a vertex twice; it needs four different ones";
    solid_.tetrahedra.push_back(indices);
    return {};
}

} // namespace taut::scene_file
