#include "taut/judge/linking.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace taut::judging {
namespace {

/// 4 pi times what two segments give to the integral: the signed area on the unit sphere of the directions
/// from points of one to points of the other.
double solid_angle(const glm::dvec3& a0, const glm::dvec3& a1, const glm::dvec3& b0, const glm::dvec3& b1)
{
    const glm::dvec3 r00 = b0 - a0, r01 = b1 - a0, r10 = b0 - a1, r11 = b1 - a1;
    std::array<glm::dvec3, 4> n{glm::cross(r00, r01), glm::cross(r01, r11), glm::cross(r11, r10),
                                glm::cross(r10, r00)};
    for (glm::dvec3& normal : n)
    {
        const double size = glm::length(normal);
        if (!(size > 0))
            return 0; // in one plane: no area
        normal /= size;
    }
    double area = 0;
    for (std::size_t k = 0; k < 4; ++k)
        area += std::asin(std::clamp(glm::dot(n[k], n[(k + 1) % 4]), -1.0, 1.0));
    return glm::dot(glm::cross(b1 - b0, a1 - a0), r00) < 0 ? -area : area;
}

} // namespace

std::optional<int> linking_number(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            sum += solid_angle(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]);
    const double number = sum / (4 * std::numbers::pi), whole = std::round(number);
    if (!(std::abs(number - whole) < 0.01))
        return std::nullopt;
    return static_cast<int>(whole);
}

} // namespace taut::judging
