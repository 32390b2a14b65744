#pragma once
// What vbd_drift sums of the rows of a part, in fp64, and the sizes of what is summed.

#include "support/block_parts.hpp"

#include <array>

namespace taut::conformance {

struct RigidSums
{
    std::array<double, TAUT_VBD_DRIFT> value{}, size{};
};

template <typename Vec4>
RigidSums rigid_sums(const BodyParts& parts, const BodyParts::Part& part, std::uint32_t first_vertex,
                     const std::vector<Vec4>& position, const std::vector<Vec4>& predicted,
                     const std::vector<Vec4>& delta, const std::vector<Vec4>& push = {})
{
    RigidSums out;
    const glm::dvec3 base(position[part.base + first_vertex]);
    for (std::uint32_t j = part.first; j < part.end && !part.held; ++j)
    {
        const std::uint32_t v = parts.order[j] + first_vertex;
        const double inertia = double(predicted[v].w);
        const glm::dvec3 d(delta[v]), lack = glm::dvec3(predicted[v]) - d;
        const glm::dvec3 r = glm::dvec3(position[v]) - base + d, turn = glm::cross(r, lack);
        const double far = glm::length(glm::dvec3(position[v])) + glm::length(base) + glm::length(d);
        const double way = glm::length(glm::dvec3(predicted[v])) + glm::length(d);
        const auto add = [&](std::size_t k, double term, double size) {
            out.value[k] += inertia * term;
            out.size[k] += inertia * size;
        };
        add(0, 1, 1);
        for (int c = 0; c < 3; ++c)
        {
            const auto k = static_cast<std::size_t>(c);
            add(1 + k, lack[c], way);
            add(4 + k, r[c], far);
            add(7 + k, turn[c], 4 * far * way);
            add(10 + k, r[c] * r[c], 2 * far * far);
            add(13 + k, r[(c + 1) % 3] * r[(c + 2) % 3], 2 * far * far);
            if (!push.empty())
                add(16 + k, double(push[v][c]), std::abs(double(push[v][c])));
        }
    }
    return out;
}

} // namespace taut::conformance
