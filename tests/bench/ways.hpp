#pragma once
// Ways to step one scene, for benches that compare them.

#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace bench {

struct Way
{
    std::string name;
    std::function<void()> step;
    std::function<std::vector<glm::dvec3>()> positions;
};

inline Way on_device(const taut::Scene& scene, const std::string& selector)
{
    const auto world = std::make_shared<taut::World>(scene, taut::Device::open(selector));
    return {selector,
            [world] {
                world->step();
                world->device().wait();
            },
            [world] { return world->positions(); }};
}

/// The largest distance between places, m.
inline double largest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double out = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        out = std::max(out, glm::distance(a[i], b[i]));
    return out;
}

} // namespace bench
