// Sums over bodies of what a solver left.
//
// Based on: Newton's laws for a whole body: forces within it cancel in the sums of forces and of torques.
// Departures: none known to be published as a measure of convergence. A sweep carries a load over one link.
//   Where too few are taken, what is left is small beside the springs' own forces, and yet the body hangs
//   in the air.

#include "taut/report/load_residual.hpp"

#include "taut/plan/stability.hpp"
#include "taut/report/element_rates.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace taut {
namespace {

/// Sums within so many times what roundings make of them say nothing.
constexpr double kNoise = 10;

std::array<std::uint32_t, 2> vertices_of(const StretchElement& e) { return {e.a, e.b}; }
std::array<std::uint32_t, 4> vertices_of(const BendElement& e)
{
    return {e.edge0, e.edge1, e.wing0, e.wing1};
}
std::array<std::uint32_t, 4> vertices_of(const VolumeElement& e) { return e.vertex; }
std::array<std::uint32_t, 4> vertices_of(const SolidElement& e) { return e.vertex; }

/// Those that are free, of bodies that touch nothing. A contact moves its vertices after they were solved, so
/// what is left beside them is its own, and more than any load in a stiff body that is where it should be.
std::vector<bool> counted_vertices(const PhysicalModel& model, const std::vector<bool>& touches)
{
    std::vector<bool> out(touches.size(), false);
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
    {
        const std::uint32_t first = model.body_start[b], last = model.body_start[b + 1];
        if (std::find(touches.begin() + first, touches.begin() + last, true) == touches.begin() + last)
            for (std::uint32_t i = first; i < last; ++i)
                out[i] = !model.pinned[i];
    }
    return out;
}

/// N/m, a vertex: of the elements between what is counted and what is held. The others' roundings cancel.
std::vector<double> stiffness_across(const PhysicalModel& model, std::span<const glm::dvec3> x,
                                     const std::vector<bool>& counted)
{
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<double> solid(x.size(), 0.0);
    const auto is_across = [&](const auto& e) {
        const auto v = vertices_of(e);
        const auto inside = std::count_if(v.begin(), v.end(), [&](std::uint32_t i) { return counted[i]; });
        return inside > 0 && inside < static_cast<std::ptrdiff_t>(v.size());
    };
    std::copy_if(model.springs.begin(), model.springs.end(), std::back_inserter(springs), is_across);
    std::copy_if(model.hinges.begin(), model.hinges.end(), std::back_inserter(hinges), is_across);
    for (const VolumeElement& e : model.volumes)
        if (is_across(e))
            reference::add_stiffness(e, x, solid);
    for (const SolidElement& e : model.solids)
        if (is_across(e))
            reference::add_stiffness(e, x, solid);
    std::vector<double> out = stiffness_rows(springs, hinges, x.size(), x);
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += solid[i];
    return out;
}

/// Of the counted vertices from `first` to before `last`; -1 where there are none.
double residual_of(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left,
                   const std::vector<bool>& counted, const std::vector<double>& across, std::uint32_t first,
                   std::uint32_t last)
{
    double mass = 0, loads = 0, arms = 0, slack = 0, turning_slack = 0;
    glm::dvec3 centre(0), force(0), torque(0);
    for (std::uint32_t i = first; i < last; ++i)
        if (counted[i])
        {
            mass += model.mass[i];
            centre += model.mass[i] * x[i];
        }
    if (!(mass > 0))
        return -1;
    centre /= mass;
    for (std::uint32_t i = first; i < last; ++i)
        if (counted[i])
        {
            const glm::dvec3 d = x[i] - centre;
            force += left.force[i];
            torque += glm::cross(d, left.force[i]);
            loads += left.load[i];
            arms += glm::length(d) * left.load[i];
            const double noise = across[i] * left.rounding;
            slack += noise * noise;
            turning_slack += glm::dot(d, d) * noise * noise;
        }
    const auto share = [](double of, double noise, double all) {
        return all > 0 && of > kNoise * noise ? of / all : 0;
    };
    return std::max(share(glm::length(force), std::sqrt(slack), loads),
                    share(glm::length(torque), std::sqrt(turning_slack), arms));
}

} // namespace

double load_residual(const PhysicalModel& model, std::span<const glm::dvec3> x, const Leftover& left)
{
    const std::vector<bool> counted = counted_vertices(model, left.touches);
    const std::vector<double> across = stiffness_across(model, x, counted);
    double worst = -1;
    for (std::size_t b = 0; b + 1 < model.body_start.size(); ++b)
        worst = std::max(worst, residual_of(model, x, left, counted, across, model.body_start[b],
                                            model.body_start[b + 1]));
    return worst;
}

} // namespace taut
