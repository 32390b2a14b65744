// Based on: Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, 4.2, 4.3: stretch along both
// yarns
//   and shear as functions of the images of a metre of each.
// Departures: strains per length and the sine of the shear, with a matrix of moduli (docs/fabric.md).

#include "taut/elements/membrane.hpp"

#include "taut/kernels/elements/membrane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Images of a metre of warp and of weft.
struct Yarns
{
    glm::dvec3 warp, weft;
};

Yarns yarns(std::span<const glm::dvec3> x, std::span<const double> p)
{
    const glm::dvec3 e1 = x[1] - x[0], e2 = x[2] - x[0];
    return {e1 * p[0] + e2 * p[2], e1 * p[1] + e2 * p[3]};
}

double energy(std::span<const glm::dvec3> x, std::span<const double> values)
{
    const auto edge = [&](std::size_t corner) {
        const glm::dvec3 e = x[corner] - x[0];
        return std::array<double, 3>{e.x, e.y, e.z};
    };
    return membrane_energy(edge(1), edge(2), values);
}

/// Singular values of [warp weft], less 1.
std::array<double, 2> stretches(std::span<const glm::dvec3> x, std::span<const double> values)
{
    const Yarns f = yarns(x, values);
    const double a = glm::dot(f.warp, f.warp), b = glm::dot(f.weft, f.weft), c = glm::dot(f.warp, f.weft);
    const double middle = (a + b) / 2, radius = std::hypot((a - b) / 2, c);
    return {std::sqrt(std::max(middle - radius, 0.0)) - 1, std::sqrt(middle + radius) - 1};
}

} // namespace

ElementKind membrane_kind()
{
    return {"membrane",
            3,
            {"p11", "p12", "p21", "p22", "c11", "c12", "c22", "c33"},
            kernels::membrane::all(),
            energy,
            stretches};
}

} // namespace taut
