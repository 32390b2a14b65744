#include "taut/world/islands.hpp"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <numeric>

namespace taut {
namespace {

/// The root of a tree of a union of sets; the path to it becomes half as long.
std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t k)
{
    while (parent[k] != k)
        k = parent[k] = parent[parent[k]];
    return k;
}

} // namespace

Extent grown(Extent box, double margin)
{
    box.low -= margin;
    box.high += margin;
    return box;
}

bool overlap(const Extent& a, const Extent& b)
{
    return glm::all(glm::lessThanEqual(glm::max(a.low, b.low), glm::min(a.high, b.high)));
}

std::vector<std::uint32_t> islands(std::span<const Extent> boxes,
                                   const std::function<bool(std::uint32_t, std::uint32_t)>& meet)
{
    std::vector<std::uint32_t> order(boxes.size()), parent(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0u);
    std::iota(parent.begin(), parent.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return boxes[a].low.x < boxes[b].low.x; });
    for (const std::uint32_t b : order)
    {
        std::erase_if(open, [&](std::uint32_t a) { return boxes[a].high.x < boxes[b].low.x; });
        for (const std::uint32_t a : open)
            if (overlap(boxes[a], boxes[b]) && meet(a, b))
            {
                const std::uint32_t one = root_of(parent, a), other = root_of(parent, b);
                parent[std::max(one, other)] = std::min(one, other);
            }
        open.push_back(b);
    }
    for (std::uint32_t k = 0; k < parent.size(); ++k)
        parent[k] = root_of(parent, k);
    return parent;
}

} // namespace taut
