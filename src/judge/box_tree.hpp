#pragma once
// Boxes of many things in a binary tree, for questions on the host: what overlaps a box, what is near it.

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace taut::judging {

/// Closed; empty as it is made.
struct Box
{
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
    bool meets(const Box& b) const
    {
        return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y &&
               low.z <= b.high.z && b.low.z <= high.z;
    }
};

/// Square of the distance between two boxes; 0 where they meet.
double squared_gap(const Box& a, const Box& b);

/// Does not change once it is made; questions may come from several threads.
class BoxTree
{
public:
    /// Thing i has boxes[i].
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Calls `visit` with each thing whose box meets `box`.
    void overlapping(const Box& box, const std::function<void(std::uint32_t)>& visit) const;

    /// Calls `visit` with things whose boxes are nearer to `box` than the root of `squared_bound`, nearest
    /// branches first. `visit` may lower the bound.
    void near(const Box& box, double& squared_bound, const std::function<void(std::uint32_t)>& visit) const;

private:
    struct Node
    {
        Box box;
        std::uint32_t first = 0, count = 0; ///< of things_; no things: children `first` and `first + 1`
    };

    void split(std::uint32_t node, const std::vector<Box>& boxes);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> things_;
    std::vector<Box> boxes_;
};

} // namespace taut::judging
