#include "taut/report/time_series.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {

void TimeSeries::add(std::uint64_t frame, double time, double max_stretch, double active_share,
                     const std::optional<SolverReport>& solved, const std::optional<double>& volume)
{
    TimeSample sample{frame, time, max_stretch};
    sample.volume = volume;
    if (active_share >= 0)
        sample.active_share = active_share;
    if (solved)
    {
        sample.linear_iterations = solved->iterations - iterations_;
        iterations_ = solved->iterations;
    }
    list_.push_back(sample);
}

std::vector<StretchElement> scene_springs(const Scene& resolved)
{
    std::vector<StretchElement> out;
    std::uint32_t first = 0;
    for (const Body& body : resolved.bodies)
    {
        std::vector<StretchElement> own = stretch_elements(body);
        for (StretchElement& e : own)
        {
            e.a += first;
            e.b += first;
        }
        if (out.empty())
            out = std::move(own);
        else
            out.insert(out.end(), own.begin(), own.end());
        first += static_cast<std::uint32_t>(body.mesh.positions.size());
    }
    return out;
}

Stretchable stretchable(const Scene& resolved) { return {scene_springs(resolved), scene_elements(resolved)}; }

double largest_stretch(std::span<const StretchElement> springs, std::span<const glm::dvec3> x,
                       std::span<const AddedElement> elements)
{
    std::optional<double> out;
    const auto take = [&](double stretch) { out = out ? std::max(*out, stretch) : stretch; };
    for (const StretchElement& e : springs)
        if (e.rest_length > 0)
            take((glm::distance(x[e.a], x[e.b]) - e.rest_length) / e.rest_length);
    for (const AddedElement& e : elements)
        if (const auto stretches = e.stretches(x))
            take((*stretches)[1]);
    return out.value_or(0);
}

} // namespace taut
