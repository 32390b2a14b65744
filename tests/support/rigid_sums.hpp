#pragma once
// What vbd_drift and momentum_sum sum of the rows of a part, in fp64, the sizes of what is summed, and the
// turn of a body that follows.

#include "support/block_parts.hpp"

#include "taut/kernels/shared/body_parts.h"

#include <glm/matrix.hpp>

#include <array>

namespace taut::conformance {

struct RigidSums
{
    std::array<double, TAUT_VBD_DRIFT> value{}, size{};
};

template <typename Vec4>
RigidSums rigid_sums(const BodyParts& parts, const BodyParts::Part& part, std::uint32_t first_vertex,
                     const std::vector<Vec4>& position, const std::vector<Vec4>& predicted,
                     const std::vector<Vec4>& delta)
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
        }
    }
    return out;
}

/// What momentum_sum sums; masses are 1 / position.w.
struct MomentumSums
{
    std::array<double, TAUT_MOMENTUM_SUMS> value{}, size{};
};

template <typename Vec4>
MomentumSums momentum_sums(const BodyParts& parts, const BodyParts::Part& part,
                           const std::vector<Vec4>& position, const std::vector<Vec4>& before,
                           const std::vector<Vec4>& delta)
{
    MomentumSums out;
    const glm::dvec3 base(position[part.base]);
    for (std::uint32_t j = part.first; j < part.end; ++j)
    {
        const std::uint32_t v = parts.order[j];
        const double mass = 1 / double(position[v].w);
        const glm::dvec3 d(delta[v]), x = glm::dvec3(position[v]) - base, r = x + d;
        const glm::dvec3 lack = glm::cross(x, glm::dvec3(before[v]) - d);
        const double far = glm::length(glm::dvec3(position[v])) + glm::length(base) + glm::length(d);
        const double way = glm::length(glm::dvec3(before[v])) + glm::length(d);
        const auto add = [&](std::size_t k, double term, double size) {
            out.value[k] += mass * term;
            out.size[k] += mass * size;
        };
        add(0, 1, 1);
        for (int c = 0; c < 3; ++c)
        {
            const auto k = static_cast<std::size_t>(c);
            add(1 + k, lack[c], 4 * far * way);
            add(4 + k, r[c], far);
            add(7 + k, r[c] * r[c], 2 * far * far);
            add(10 + k, r[(c + 1) % 3] * r[(c + 2) % 3], 2 * far * far);
        }
    }
    return out;
}

/// The turn w of I w = `angular` about the centre of mass; means as in kernels/shared/rigid_turn.glsl. 0 of a
/// body on a line or a point.
inline glm::dvec3 rigid_turn_of(const glm::dvec3& angular, const glm::dvec3& c, const glm::dvec3& squares,
                                const glm::dvec3& products)
{
    const glm::dvec3 square = squares - c * c, mixed = products - glm::dvec3(c.y * c.z, c.z * c.x, c.x * c.y);
    const double trace = square.x + square.y + square.z;
    const glm::dmat3 tensor(trace - square.x, -mixed.z, -mixed.y, -mixed.z, trace - square.y, -mixed.x,
                            -mixed.y, -mixed.x, trace - square.z);
    const bool wide = trace > 1e-4 * glm::dot(c, c); // else it is rounding
    if (!wide || !(glm::determinant(tensor) > 8e-6 * trace * trace * trace))
        return glm::dvec3(0);
    return glm::inverse(tensor) * angular;
}

} // namespace taut::conformance
