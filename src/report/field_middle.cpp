#include "taut/report/field_middle.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace taut {
namespace {

/// Slope of the distance: 1 beside the axis, 0.71 where two faces meet squarely.
constexpr double kFlat = 0.6;
constexpr std::size_t kMostCells = 256;

/// Half the way that is inside, through a point along an axis.
double half_run(const DistanceField& field, std::array<std::size_t, 3> at, std::size_t axis)
{
    const auto inside = [&] { return field.values[field.index(at[0], at[1], at[2])] < 0; };
    const std::size_t from = at[axis];
    std::size_t steps = 0;
    for (; inside(); ++at[axis]) // the border is outside
        ++steps;
    for (at[axis] = from; inside(); --at[axis])
        ++steps;
    return 0.5 * static_cast<double>(steps) * field.cell;
}

std::optional<DeepPoint> deep_point(const DistanceField& field, const std::array<std::size_t, 3>& at)
{
    const std::size_t index = field.index(at[0], at[1], at[2]);
    if (!(field.values[index] < 0))
        return {};
    const std::size_t strides[] = {1, field.points[0], std::size_t(field.points[0]) * field.points[1]};
    glm::dvec3 slope(0);
    for (int axis = 0; axis < 3; ++axis)
    {
        const std::size_t stride = strides[static_cast<std::size_t>(axis)];
        slope[axis] = (field.values[index + stride] - field.values[index - stride]) / (2 * field.cell);
    }
    if (glm::length(slope) > kFlat)
        return {};
    DeepPoint out{field.place(at[0], at[1], at[2]) - field.middle(), -double(field.values[index]), {}};
    for (int axis = 0; axis < 3; ++axis)
        out.half[axis] = half_run(field, at, static_cast<std::size_t>(axis));
    return out;
}

/// Of points from the deepest on those that are further from all before than `share` of their depth; empty
/// where they would be too many.
std::vector<DeepPoint> thinned(const std::vector<DeepPoint>& points, double share)
{
    std::vector<DeepPoint> out;
    for (const DeepPoint& p : points)
    {
        const double near = share * p.depth;
        if (std::any_of(out.begin(), out.end(),
                        [&](const DeepPoint& q) { return glm::distance(p.place, q.place) <= near; }))
            continue;
        if (out.size() == kMostCells)
            return {};
        out.push_back(p);
    }
    return out;
}

/// Calls f(point) with 45 of a triangle.
template <typename F>
void each_sample(const std::array<glm::dvec3, 3>& t, const F& f)
{
    constexpr int kParts = 8;
    for (int i = 0; i <= kParts; ++i)
        for (int j = 0; j <= kParts - i; ++j)
        {
            const double a = double(i) / kParts, b = double(j) / kParts;
            f(a * t[0] + b * t[1] + (1 - a - b) * t[2]);
        }
}

} // namespace

std::vector<DeepPoint> deep_points(const DistanceField& field)
{
    std::vector<DeepPoint> all;
    for (std::size_t k = 1; k + 1 < field.points[2]; ++k)
        for (std::size_t j = 1; j + 1 < field.points[1]; ++j)
            for (std::size_t i = 1; i + 1 < field.points[0]; ++i)
                if (const auto found = deep_point(field, {i, j, k}))
                    all.push_back(*found);
    std::stable_sort(all.begin(), all.end(),
                     [](const DeepPoint& a, const DeepPoint& b) { return a.depth > b.depth; });
    std::vector<DeepPoint> out;
    for (double share = 1; out.empty() && !all.empty(); share *= 1.5)
        out = thinned(all, share);
    return out;
}

double depth_in_field(const DistanceField& field, const std::array<glm::dvec3, 3>& triangle)
{
    double depth = 0;
    each_sample(triangle,
                [&](const glm::dvec3& p) { depth = std::max(depth, -field.distance(field.middle() + p)); });
    return depth;
}

bool lies_deep_in_field(const DistanceField& field, const std::vector<DeepPoint>& deep,
                        const std::array<glm::dvec3, 3>& triangle)
{
    bool found = false;
    each_sample(triangle, [&](const glm::dvec3& p) {
        const double depth = found ? 0 : -field.distance(field.middle() + p);
        if (!(depth > 0))
            return;
        const auto nearer = [&](const DeepPoint& a, const DeepPoint& b) {
            return glm::distance(a.place, p) < glm::distance(b.place, p);
        };
        const auto nearest = std::min_element(deep.begin(), deep.end(), nearer);
        found = nearest != deep.end() && depth > 0.5 * nearest->depth;
    });
    return found;
}

} // namespace taut
