#include "taut/scene/distance_field.hpp"

#include "taut/runtime/base/shown.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut {
namespace {

constexpr double kLeastCell = 1e-15; ///< m: squares of it are numbers in single precision
constexpr double kFlattest = 0.5; ///< somewhere distances of neighbours differ by nearly a cell
constexpr double kSteepest = 1.5; ///< of distances 1; some files have a little more where they were swept

std::string at_point(const DistanceField& field, std::size_t index)
{
    const std::size_t row = field.points[0], layer = row * field.points[1];
    return "(" + std::to_string(index % row) + ", " + std::to_string(index % layer / row) + ", " +
           std::to_string(index / layer) + ")";
}

std::string fault_of_size(const DistanceField& field)
{
    std::size_t wanted = 1;
    for (const std::uint32_t n : field.points)
    {
        if (n < 2)
            return "has " + std::to_string(n) + " points along an axis; there must be two at least";
        if (n > kMostFieldPoints / wanted)
            return "has more than " + std::to_string(kMostFieldPoints) + " points; take larger cells";
        wanted *= n;
    }
    if (!(field.cell >= kLeastCell && field.cell <= 1 / kLeastCell))
        return "has cells of " + shown(field.cell, 4) + " m; they must be from 1e-15 to 1e15";
    const glm::dvec3 high = field.low + 2.0 * field.half_size();
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(field.low[axis]) <= 1e30 && std::abs(high[axis]) <= 1e30))
            return "has points beyond 1e30 m";
    if (field.values.size() != wanted)
        return "has " + std::to_string(field.values.size()) + " values; its points are " +
               std::to_string(wanted);
    return {};
}

/// Of one point and the next along each axis; `steepest` becomes the most that neighbours differ by, m.
std::string fault_at(const DistanceField& field, const std::array<std::size_t, 3>& at, double& steepest)
{
    const std::size_t index = field.index(at[0], at[1], at[2]);
    const float value = field.values[index];
    if (!std::isfinite(value))
        return "has a value that is not finite at point " + at_point(field, index);
    bool border = false;
    const std::size_t strides[] = {1, field.points[0], std::size_t(field.points[0]) * field.points[1]};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
        const bool last = at[axis] + 1 == field.points[axis];
        border = border || at[axis] == 0 || last;
        const double next = last ? value : field.values[index + strides[axis]];
        if (std::abs(next - value) > kSteepest * field.cell)
            return "goes from " + shown(value, 4) + " to " + shown(next, 4) + " m between point " +
                   at_point(field, index) + " and its neighbour, which are " + shown(field.cell, 4) +
                   " m apart: distances do not";
        steepest = std::max(steepest, std::abs(next - value));
    }
    if (border && !(value > 0))
        return "is " + shown(value, 4) + " m at point " + at_point(field, index) +
               " of the grid's border; the surface must lie within, so that all of the border is above 0";
    return {};
}

/// The share along a cell and the cell's first point, of a coordinate in cells.
std::size_t cell_of(double& at, std::uint32_t points)
{
    at = at > 0 ? std::min(at, points - 1.0) : 0.0; // what is not a number becomes 0
    const std::size_t first = std::min<std::size_t>(static_cast<std::size_t>(at), points - 2);
    at -= static_cast<double>(first);
    return first;
}

} // namespace

glm::dvec3 DistanceField::half_size() const
{
    return 0.5 * cell * (glm::dvec3(points[0], points[1], points[2]) - 1.0);
}

glm::dvec3 DistanceField::middle() const { return low + half_size(); }

double DistanceField::distance(const glm::dvec3& p) const
{
    glm::dvec3 share = (p - low) / cell;
    const glm::dvec3 before = share;
    std::array<std::size_t, 3> first;
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto k = static_cast<std::size_t>(axis);
        first[k] = cell_of(share[axis], points[k]);
    }
    double corner[2] = {0, 0};
    for (const std::size_t k : {0, 1})
    {
        double row[2];
        for (const std::size_t j : {0, 1})
        {
            const std::size_t at = index(first[0], first[1] + j, first[2] + k);
            row[j] = glm::mix(double(values[at]), double(values[at + 1]), share.x);
        }
        corner[k] = glm::mix(row[0], row[1], share.y);
    }
    const double within = glm::mix(corner[0], corner[1], share.z);
    const glm::dvec3 off = cell * (before - share - glm::dvec3(first[0], first[1], first[2]));
    const double beyond = glm::dot(off, off);
    return beyond > 0 ? std::sqrt(beyond + within * within) : within;
}

glm::dvec3 DistanceField::normal(const glm::dvec3& p) const
{
    glm::dvec3 slope(0);
    for (int axis = 0; axis < 3; ++axis)
    {
        glm::dvec3 step(0);
        step[axis] = 0.5 * cell;
        slope[axis] = distance(p + step) - distance(p - step);
    }
    const double size = glm::length(slope);
    return size > 0 ? slope / size : glm::dvec3(0, 1, 0);
}

double DistanceField::depth() const
{
    return values.empty() ? 0 : std::max(0.0, -double(*std::min_element(values.begin(), values.end())));
}

double DistanceField::margin() const
{
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points[2]; ++k)
        for (std::size_t j = 0; j < points[1]; ++j)
        {
            const bool side = k == 0 || k + 1 == points[2] || j == 0 || j + 1 == points[1];
            for (std::size_t i = 0; i < points[0]; i += side ? 1 : points[0] - 1)
                out = std::min(out, double(values[index(i, j, k)]));
        }
    return out;
}

std::string fault_of(const DistanceField& field)
{
    if (std::string fault = fault_of_size(field); !fault.empty())
        return fault;
    double steepest = 0;
    for (std::size_t k = 0; k < field.points[2]; ++k)
        for (std::size_t j = 0; j < field.points[1]; ++j)
            for (std::size_t i = 0; i < field.points[0]; ++i)
                if (std::string fault = fault_at(field, {i, j, k}, steepest); !fault.empty())
                    return fault;
    if (steepest < kFlattest * field.cell)
        return "changes by " + shown(steepest, 4) + " m at most between neighbours that are " +
               shown(field.cell, 4) + " m apart: its values are no distances, or of another unit";
    if (field.depth() == 0)
        return "has no value below 0: nothing is inside, so there is no surface";
    return {};
}

} // namespace taut
