// Based on: Feingold, Varga, Block Diagonally Dominant Matrices and Generalizations of the Gerschgorin Circle
//   Theorem, 1962; the Hessians of solid.hpp and surface.hpp, term by term.
// Departures: the norm of a block is the sum of the norms of its terms. The second derivative of J by two
//   corners with the gradients b_i and b_j takes d and e to (e x d) . F (b_i x b_j).
#include "taut/report/element_rates.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace taut::reference {
namespace {

/// det F differentiated by F.
glm::dmat3 cofactor(const glm::dmat3& f)
{
    return {glm::cross(f[1], f[2]), glm::cross(f[2], f[0]), glm::cross(f[0], f[1])};
}

/// How much a difference of a volume from its rest volume adds where the volume's gradient turns.
double pressure(double volume, double rest_volume, double compliance)
{
    return volume == rest_volume ? 0 : std::abs(volume - rest_volume) / compliance;
}

} // namespace

void add_stiffness(const SolidElement& e, std::span<const glm::dvec3> x, std::span<double> rows)
{
    const glm::dmat3 f = deformation(e, x), area = cofactor(f), rest = glm::transpose(e.inverse_rest);
    const std::array<glm::dvec3, 4> slope = {-(rest[0] + rest[1] + rest[2]), rest[0], rest[1], rest[2]};
    const double grown = glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]) + 1;
    const double shear = std::abs(e.mu * (1 - e.log / grown)), log = 2 * e.mu * e.log / (grown * grown);
    const double push = std::abs(e.lambda * (glm::determinant(f) - e.rest));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            rows[e.vertex[i]] +=
                e.rest_volume * (shear * std::abs(glm::dot(slope[i], slope[j])) +
                                 log * glm::length(f * slope[i]) * glm::length(f * slope[j]) +
                                 e.lambda * glm::length(area * slope[i]) * glm::length(area * slope[j]) +
                                 push * glm::length(f * glm::cross(slope[i], slope[j])));
}

void add_stiffness(const VolumeElement& e, std::span<const glm::dvec3> x, std::span<double> rows)
{
    const std::array<glm::dvec3, 4> slope = volume_gradient(e.vertex, x);
    const double push = pressure(volume_of(e.vertex, x), e.rest_volume, e.compliance);
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
        {
            rows[e.vertex[i]] += glm::length(slope[i]) * glm::length(slope[j]) / e.compliance;
            if (i == j || push == 0)
                continue;
            std::array<std::size_t, 2> other{}; // the ends of the opposite edge
            std::size_t found = 0;
            for (std::size_t k = 0; k < 4; ++k)
                if (k != i && k != j)
                    other[found++] = k;
            rows[e.vertex[i]] += push * glm::distance(x[e.vertex[other[0]]], x[e.vertex[other[1]]]) / 6;
        }
}

void add_stiffness(const SurfaceElement& e, std::span<const glm::dvec3> x, std::span<double> rows)
{
    std::vector<glm::dvec3> slope(x.size(), glm::dvec3(0));
    add_volume_gradient(e.triangles, x, 1, slope);
    double sum = 0;
    for (const glm::dvec3& g : slope)
        sum += glm::length(g);
    for (std::size_t v = 0; v < x.size(); ++v)
        if (const double own = glm::length(slope[v]); own > 0)
            rows[v] += own * sum / e.compliance;
    const double push = pressure(enclosed_volume(e.triangles, x), e.rest_volume, e.compliance);
    if (push == 0)
        return;
    // By a closed surface the origin does not matter: corners are counted from the first.
    const glm::dvec3 origin = x[e.triangles[0][0]];
    for (const auto& t : e.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t other = 1; other < 3; ++other)
                rows[t[c]] += push * glm::distance(x[t[(c + other) % 3]], origin) / 6;
}

} // namespace taut::reference
