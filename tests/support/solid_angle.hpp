#pragma once
// Whether a point goes through a surface, told by the angle under which it sees it: shares nothing with
// taut::CrossingWatch.

#include "taut/scene/collider.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace taut::test {

/// Of a mesh's triangles with vertices at x, as seen from a point. Van Oosterom, Strackee. 1983.
inline double solid_angle(const Mesh& mesh, const std::vector<glm::dvec3>& x, const glm::dvec3& from)
{
    double sum = 0;
    for (const auto& t : mesh.triangles)
    {
        const glm::dvec3 a = x[t[0]] - from, b = x[t[1]] - from, c = x[t[2]] - from;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                              la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    return sum;
}

/// Looked at after every substep, the angle jumps by 4 pi where the centre of the first collider goes through
/// the first body, and only then.
class Truth
{
public:
    void look(const Scene& scene, double time, const std::vector<glm::dvec3>& x)
    {
        const double now =
            solid_angle(scene.bodies[0].mesh, x, frame_at(scene.colliders[0], time).centre);
        through_ = through_ || (looked_ && std::abs(now - angle_) > 2 * std::numbers::pi);
        finite_ = finite_ && std::isfinite(now);
        looked_ = true;
        angle_ = now;
    }
    bool through() const { return through_; }
    bool finite() const { return finite_; }

private:
    double angle_ = 0;
    bool looked_ = false, through_ = false, finite_ = true;
};

} // namespace taut::test
