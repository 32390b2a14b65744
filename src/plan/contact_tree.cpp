#include "taut/plan/contact_tree.hpp"

#include "taut/kernels/shared/contact_rows.h"

#include <glm/common.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace taut {
namespace {

struct Placed
{
    ContactLeaf leaf;
    glm::dvec3 centre{0}; ///< three times it
    std::size_t number = 0;
};

void split(std::span<Placed> all, std::size_t leaves)
{
    const std::size_t half = leaves / 2;
    if (all.size() <= 1 || half == 0)
        return;
    if (all.size() <= half)
        return split(all, half);
    glm::dvec3 low = all.front().centre, high = low;
    for (const Placed& p : all)
    {
        low = glm::min(low, p.centre);
        high = glm::max(high, p.centre);
    }
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(half), all.end(),
                     [&](const Placed& a, const Placed& b) {
                         return std::pair(a.centre[axis], a.number) < std::pair(b.centre[axis], b.number);
                     });
    split(all.first(half), half);
    split(all.subspan(half), half);
}

} // namespace

std::uint32_t leaves_for(std::uint32_t count)
{
    std::uint32_t leaves = 1;
    while (leaves < count)
        leaves *= 2;
    return leaves;
}

std::vector<ContactLeaf> in_tree_order(std::vector<ContactLeaf> triangles, std::span<const glm::dvec3> x)
{
    std::vector<Placed> placed;
    for (std::size_t k = 0; k < triangles.size(); ++k)
    {
        const auto& [a, b, c] = triangles[k].corner;
        placed.push_back({triangles[k], x[a] + x[b] + x[c], k});
    }
    split(placed, leaves_for(static_cast<std::uint32_t>(placed.size())));
    std::transform(placed.begin(), placed.end(), triangles.begin(), [](const Placed& p) { return p.leaf; });
    return triangles;
}

void share_out(std::vector<ContactLeaf>& leaves)
{
    std::set<std::uint32_t> vertices;
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (ContactLeaf& leaf : leaves)
    {
        leaf.owns = 0;
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const auto [low, high] = std::minmax(leaf.corner[k], leaf.corner[(k + 1) % 3]);
            leaf.owns |= vertices.insert(leaf.corner[k]).second ? 1u << k : 0u;
            leaf.owns |= sides.insert({low, high}).second ? 1u << (TAUT_CONTACT_OWNS_SIDE + k) : 0u;
        }
    }
}

} // namespace taut
