#include "taut/judge/box_tree.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace taut::judging {
namespace {

constexpr std::uint32_t kLeaf = 4; ///< things of a leaf, at most

} // namespace

double squared_gap(const Box& a, const Box& b)
{
    const glm::dvec3 apart = glm::max(glm::max(a.low - b.high, b.low - a.high), glm::dvec3(0));
    return glm::dot(apart, apart);
}

BoxTree::BoxTree(const std::vector<Box>& boxes) : things_(boxes.size()), boxes_(boxes)
{
    std::iota(things_.begin(), things_.end(), 0u);
    nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size())});
    for (std::uint32_t node = 0; node < nodes_.size(); ++node)
        split(node, boxes);
}

/// In halves by the middles of the boxes, along the longest side.
void BoxTree::split(std::uint32_t node, const std::vector<Box>& boxes)
{
    const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
    Box middles;
    for (std::uint32_t k = first; k < first + count; ++k)
    {
        const Box& box = boxes[things_[k]];
        nodes_[node].box.add(box);
        middles.add((box.low + box.high) / 2.0);
    }
    if (count <= kLeaf)
        return;
    const glm::dvec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = things_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
        return boxes[a].low[axis] + boxes[a].high[axis] < boxes[b].low[axis] + boxes[b].high[axis];
    });
    nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].count = 0;
    nodes_.push_back({{}, first, count / 2});
    nodes_.push_back({{}, first + count / 2, count - count / 2});
}

void BoxTree::overlapping(const Box& box, const std::function<void(std::uint32_t)>& visit) const
{
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty())
    {
        const Node& node = nodes_[waiting.back()];
        waiting.pop_back();
        if (!node.box.meets(box))
            continue;
        if (node.count == 0 && nodes_.size() > 1)
            waiting.insert(waiting.end(), {node.first + 1, node.first});
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
            if (boxes_[things_[k]].meets(box))
                visit(things_[k]);
    }
}

void BoxTree::near(const Box& box, double& squared_bound,
                   const std::function<void(std::uint32_t)>& visit) const
{
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty())
    {
        const Node& node = nodes_[waiting.back()];
        waiting.pop_back();
        if (!(squared_gap(node.box, box) < squared_bound))
            continue;
        if (node.count == 0 && nodes_.size() > 1)
        {
            const bool second_first =
                squared_gap(nodes_[node.first + 1].box, box) < squared_gap(nodes_[node.first].box, box);
            const std::uint32_t nearer = node.first + (second_first ? 1 : 0);
            const std::uint32_t farther = node.first + (second_first ? 0 : 1);
            waiting.insert(waiting.end(), {farther, nearer});
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
            if (squared_gap(boxes_[things_[k]], box) < squared_bound)
                visit(things_[k]);
    }
}

} // namespace taut::judging
