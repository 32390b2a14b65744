#pragma once
// Random and degenerate tetrahedra for the tests of kernels that move them.

#include "support/colours.hpp"

#include <algorithm>
#include <cmath>

namespace taut::conformance {

using TetrahedronCorners = std::array<glm::dvec3, 4>;

inline double triple(const TetrahedronCorners& x)
{
    return glm::dot(glm::cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]);
}

/// How the volume changes with each corner, m^2.
inline std::array<glm::dvec3, 4> volume_slopes(const TetrahedronCorners& x)
{
    const glm::dvec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    const glm::dvec3 ga = glm::cross(b, c) / 6.0, gb = glm::cross(c, a) / 6.0, gc = glm::cross(a, b) / 6.0;
    return {-(ga + gb + gc), ga, gb, gc};
}

/// Smallest height over largest edge.
inline double thinness(const TetrahedronCorners& x)
{
    double largest = 0, area = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
        for (std::size_t j = i + 1; j < 4; ++j)
            largest = std::max(largest, glm::length(x[i] - x[j]));
        const std::size_t a = (i + 1) % 4, b = (i + 2) % 4, c = (i + 3) % 4;
        area = std::max(area, glm::length(glm::cross(x[b] - x[a], x[c] - x[a])));
    }
    return area > 0 ? std::abs(triple(x)) / area / largest : 0;
}

/// Edges of some 1 m, right-handed, no sliver.
inline TetrahedronCorners random_tetrahedron(Random& random)
{
    TetrahedronCorners x;
    do
        for (glm::dvec3& corner : x)
            corner = {random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7)};
    while (thinness(x) < 0.3);
    if (triple(x) < 0)
        std::swap(x[2], x[3]);
    return x;
}

/// Adds a colour of `count` tetrahedra with vertices of their own; `make(corners, rest)` gives the record
/// from vertex numbers and rest shape, `multipliers` numbers each.
template <typename Input, typename Make>
void add_tetrahedra(Input& in, Random& random, std::uint32_t count, std::uint32_t multipliers,
                    const Make& make)
{
    using Real = typename decltype(in.position)::value_type::value_type;
    const auto base = static_cast<std::uint32_t>(in.position.size());
    const auto order = random.shuffled(4 * count);
    in.position.resize(base + 4 * count);
    const auto more = random.vec4s<Real>(4 * count, 1e-2, 0, 1e-3);
    in.delta.insert(in.delta.end(), more.begin(), more.end());
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const TetrahedronCorners rest = random_tetrahedron(random);
        std::array<std::uint32_t, 4> vertex;
        for (std::uint32_t v = 0; v < 4; ++v)
        {
            vertex[v] = base + order[4 * i + v];
            const glm::dvec3 moved = rest[v] + 0.2 * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1),
                                                               random.uniform(-1, 1));
            in.position[vertex[v]] = glm::vec<4, Real>(glm::vec<3, Real>(moved), random.inverse_mass<Real>());
        }
        in.constraint.push_back(make(vertex, rest));
        for (std::uint32_t k = 0; k < multipliers; ++k)
            in.multiplier.push_back(random.uniform<Real>(-1e-3, 1e-3));
    }
    in.colour_start.push_back(static_cast<std::uint32_t>(in.constraint.size()));
    in.step.inverse_substep = Real(60);
}

/// Corners as a test puts them, at the first constraint of a colour on.
template <typename Input>
void place(Input& in, std::uint32_t k, const TetrahedronCorners& x, const std::array<double, 4>& weight)
{
    using Real = typename decltype(in.position)::value_type::value_type;
    const auto& c = in.constraint[k];
    const std::uint32_t vertex[4] = {c.a, c.b, c.c, c.d};
    for (std::size_t v = 0; v < 4; ++v)
    {
        in.position[vertex[v]] =
            glm::vec<4, Real>(glm::vec<3, Real>(x[v]), static_cast<Real>(weight[v]));
        in.delta[vertex[v]] = glm::vec<4, Real>(Real(0));
    }
}

} // namespace taut::conformance
