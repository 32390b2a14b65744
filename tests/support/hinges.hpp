#pragma once
// Hinges for tests of kernels: random ones, such without an angle, and the angle with its derivatives.

#include "support/dual.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace taut::conformance {

using Corners = std::array<glm::dvec3, 4>; ///< both ends of the edge, then both wings
inline constexpr double kPi = std::numbers::pi;

/// The signed angle between the planes of two triangles about their edge, with all twelve derivatives.
inline Dual<12> hinge_angle(const Corners& x)
{
    std::array<Dual3<12>, 4> p;
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t k = 0; k < 3; ++k)
            p[v][k] = Dual<12>::variable(x[v][static_cast<int>(k)], 3 * v + k);
    const Dual3<12> edge = unit(p[1] - p[0]);
    const Dual3<12> n1 = unit(cross(p[1] - p[0], p[2] - p[0]));
    const Dual3<12> n2 = unit(cross(p[3] - p[0], p[1] - p[0]));
    return atan2(dot(cross(n1, n2), edge), dot(n1, n2));
}

inline double height(const glm::dvec3& wing, const glm::dvec3& from, const glm::dvec3& edge)
{
    const double size = glm::length(edge);
    return size > 0 ? glm::length(glm::cross(wing - from, edge)) / size : 0;
}

template <typename Real>
glm::vec<4, Real> with_weight(const glm::dvec3& x, Real w)
{
    return {static_cast<Real>(x.x), static_cast<Real>(x.y), static_cast<Real>(x.z), w};
}

/// Four corners with edges near 1: the wings stand at `open` and `open + bend` around the edge.
inline Corners random_hinge(Random& random)
{
    const glm::dvec3 e = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)) + glm::dvec3(0, 0, 1e-3));
    const glm::dvec3 side = glm::normalize(glm::cross(e, glm::dvec3(0.6, -0.48, 0.64)));
    const glm::dvec3 up = glm::cross(e, side);
    const glm::dvec3 start(random.vec4<double>(1, 0));
    const auto wing = [&] {
        const double angle = random.uniform(-kPi, kPi), far = random.uniform(0.4, 1.2),
                     along = random.uniform(-0.2, 1.2);
        return start + e * along + (side * std::cos(angle) + up * std::sin(angle)) * far;
    };
    const glm::dvec3 first = wing(), second = wing();
    return {start, start + e * random.uniform(0.5, 1.5), first, second};
}

struct SpecialHinge
{
    Corners x;
    double rest, w[4];
};

/// Hinges that have no angle, or one at the border of its range.
inline std::span<const SpecialHinge> special_hinges()
{
    static const glm::dvec3 o(0), e(1, 0, 0), up(0.25, 1, 0), down(0.5, -1, 0), on_edge(0.5, 0, 0);
    static const SpecialHinge specials[] = {
        {{o, e, on_edge, down}, 0.3, {1, 1, 1, 1}}, // wing on the edge: counted
        {{o, e, up, o}, 0.3, {1, 1, 1, 1}},         // wing at a corner: counted
        {{o, o, up, down}, 0.3, {1, 1, 1, 1}},      // no edge: counted
        {{o, o, o, o}, 0.3, {1, 0, 0, 0}},          // a point: counted
        {{o, e, on_edge, down}, 0.3, {0, 0, 0, 0}}, // held: not counted
        {{o, e, up, down}, 0.3, {0, 0, 0, 0}},      // held, sound: counted as unusable only if it can move
        {{o, e, up, down}, 0.0, {1, 1, 1, 1}},      // flat as it should be
        {{o, e, up, down}, 0.5, {1, 2, 3, 4}},      // flat
        {{o, e, up, up}, kPi, {1, 1, 1, 1}},        // folded as it should be
        {{o, e, up, up}, -3.0, {1, 1, 1, 1}},       // folded, rest angle across the border
        {{o, e, up, glm::dvec3(0.5, 1, 1e-3)}, -3.1, {1, 1, 0, 0}}, // nearly folded, wings held
        {{o, e, up, glm::dvec3(0.5, 1, -1e-3)}, 3.1, {0, 0, 1, 1}}, // the other way, edge held
        {{o, e, glm::dvec3(0.01, 1, 0), glm::dvec3(0.02, -1, 0)}, 0.3, {0, 1, 0, 0}}, // hardly a part in it
    };
    return specials;
}

} // namespace taut::conformance
