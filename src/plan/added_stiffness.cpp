// Based on: Gershgorin's circles for 3 x 3 blocks (stability.cpp), with the Frobenius norm of each block;
//   of a spring that is its stiffness.
// Departures: the blocks are central differences of the energy alone, over 1e-4 of the element's size: about
//   eight digits, where a bound needs one.
#include "taut/plan/added_stiffness.hpp"

#include "taut/elements/element.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace taut {
namespace {

constexpr double kShare = 1e-4; ///< of an element's size

using CornerPlaces = std::array<glm::dvec3, 4>;

struct Element
{
    const ElementKind& kind;
    std::span<const double> values;
    CornerPlaces x{};

    /// With axes i and j of all corners moved by these.
    double energy(std::size_t i, double by, std::size_t j, double also) const
    {
        CornerPlaces moved = x;
        moved[i / 3][static_cast<int>(i % 3)] += by;
        moved[j / 3][static_cast<int>(j % 3)] += also;
        return kind.energy(std::span(moved).first(kind.corners), values);
    }
    double size() const
    {
        double most = 0;
        for (std::uint32_t c = 1; c < kind.corners; ++c)
            most = std::max(most, glm::distance(x[c], x[0]));
        return most;
    }
};

/// d^2 E / dx_i dx_j.
double curvature(const Element& e, std::size_t i, std::size_t j, double step)
{
    return ((e.energy(i, step, j, step) - e.energy(i, step, j, -step)) -
            (e.energy(i, -step, j, step) - e.energy(i, -step, j, -step))) /
           (4 * step * step);
}

/// Frobenius norm of the block of two corners.
double block_size(const Element& e, std::size_t corner, std::size_t other, double step)
{
    double squares = 0;
    for (std::size_t k = 0; k < 9; ++k)
        squares += std::pow(curvature(e, 3 * corner + k / 3, 3 * other + k % 3, step), 2);
    return std::sqrt(squares);
}

void add_rows(const Element& e, std::span<const std::uint32_t> vertices, std::vector<double>& rows)
{
    const double step = kShare * e.size();
    std::array<double, 4> sum{};
    for (std::size_t c = 0; step > 0 && c < e.kind.corners; ++c)
        for (std::size_t other = 0; other <= c; ++other)
        {
            const double size = block_size(e, c, other, step);
            if (!std::isfinite(size))
                return;
            sum[c] += size;
            sum[other] += other == c ? 0 : size;
        }
    for (std::size_t c = 0; c < e.kind.corners; ++c)
        rows[vertices[c]] += sum[c];
}

} // namespace

std::vector<double> added_stiffness_rows(const Body& body, std::span<const glm::dvec3> x)
{
    std::vector<double> rows(x.size(), 0.0);
    for (const Body::Elements& list : body.elements)
    {
        const ElementKind* kind = find_element(list.kind); // check_added_elements has refused others
        const std::size_t corners = kind->corners, values = kind->values.size();
        for (std::size_t k = 0; k < list.vertices.size() / corners; ++k)
        {
            const auto vertices = std::span(list.vertices).subspan(k * corners, corners);
            Element e{*kind, std::span(list.values).subspan(k * values, values)};
            for (std::size_t c = 0; c < corners; ++c)
                e.x[c] = x[vertices[c]];
            add_rows(e, vertices, rows);
        }
    }
    return rows;
}

} // namespace taut
