// Based on: Hestenes, Stiefel, Methods of Conjugate Gradients for Solving Linear Systems, 1952; scaled by the
//   diagonal, the matrix has at most the condition of the worst triangle (Wathen 1987).
// Departures: none.
#include "taut/report/plate_energy.hpp"

#include "taut/report/model.hpp"

#include <cmath>

namespace taut {
namespace {

using Values = std::vector<double>;

double dot(const Values& a, const Values& b)
{
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += a[k] * b[k];
    return sum;
}

Values turns(std::span<const PlateHinge> hinges, std::span<const glm::dvec3> x)
{
    Values out;
    out.reserve(hinges.size());
    for (const PlateHinge& h : hinges)
        out.push_back(bend_angle(h.element, x));
    return out;
}

/// A m, and what is left after scaling by the diagonal.
Values product(std::span<const PlateHinge> hinges, const Values& m)
{
    Values out(m.size());
    for (std::size_t k = 0; k < m.size(); ++k)
    {
        out[k] = hinges[k].softness * m[k];
        for (std::size_t n = 0; n < 4; ++n)
            out[k] += hinges[k].coupling[n] * m[hinges[k].neighbour[n] / 2];
    }
    return out;
}

Values solve(std::span<const PlateHinge> hinges, const Values& right)
{
    constexpr int kMost = 5000;
    constexpr double kTolerance = 1e-10;
    const std::size_t n = right.size();
    Values m(n, 0.0), rest = right, scaled(n), along(n);
    const auto scale = [&] {
        for (std::size_t k = 0; k < n; ++k)
            scaled[k] = rest[k] / hinges[k].softness;
        return dot(rest, scaled);
    };
    double size = scale();
    const double enough = kTolerance * kTolerance * size;
    along = scaled;
    for (int i = 0; i < kMost && size > enough; ++i)
    {
        const Values image = product(hinges, along);
        const double step = size / dot(along, image);
        for (std::size_t k = 0; k < n; ++k)
        {
            m[k] += step * along[k];
            rest[k] -= step * image[k];
        }
        const double before = size;
        size = scale();
        for (std::size_t k = 0; k < n; ++k)
            along[k] = scaled[k] + size / before * along[k];
    }
    return m;
}

} // namespace

std::vector<double> plate_moments(std::span<const PlateHinge> hinges, std::span<const glm::dvec3> x)
{
    return solve(hinges, turns(hinges, x));
}

double plate_energy(std::span<const PlateHinge> hinges, std::span<const glm::dvec3> x)
{
    const Values turn = turns(hinges, x);
    return 0.5 * dot(turn, solve(hinges, turn));
}

} // namespace taut
