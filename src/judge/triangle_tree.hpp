#pragma once
// The triangles of a surface in trees, for features that ask which of them they are to be compared with.

#include "taut/judge/box_tree.hpp"
#include "taut/judge/surface.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace taut::judging {

/// At one state of the surface. What is led is not judged against its like, so it has a tree of the others.
class TriangleTrees
{
public:
    TriangleTrees(const Surface& surface, const std::vector<glm::dvec3>& positions)
        : all_(numbers(surface, false)),
          free_(numbers(surface, true)),
          of_all_(boxes(surface, positions, all_)),
          of_free_(boxes(surface, positions, free_))
    {}

    /// Calls `visit` with triangles whose boxes meet `box`; for a feature that is led (Surface::is_led) with
    /// those that are not.
    void overlapping(bool led, const Box& box, const std::function<void(std::uint32_t)>& visit) const
    {
        const std::vector<std::uint32_t>& number = led ? free_ : all_;
        (led ? of_free_ : of_all_).overlapping(box, [&](std::uint32_t k) { visit(number[k]); });
    }

private:
    static std::vector<std::uint32_t> numbers(const Surface& surface, bool free)
    {
        std::vector<std::uint32_t> out;
        for (std::uint32_t t = 0; t < surface.triangles.size(); ++t)
            if (!free || !surface.is_led(surface.triangles[t]))
                out.push_back(t);
        return out;
    }
    static std::vector<Box> boxes(const Surface& surface, const std::vector<glm::dvec3>& positions,
                                  const std::vector<std::uint32_t>& triangles)
    {
        std::vector<Box> out(triangles.size());
        for (std::size_t k = 0; k < out.size(); ++k)
            for (const std::uint32_t v : surface.triangles[triangles[k]])
                out[k].add(positions[v]);
        return out;
    }

    std::vector<std::uint32_t> all_, free_;
    BoxTree of_all_, of_free_;
};

} // namespace taut::judging
