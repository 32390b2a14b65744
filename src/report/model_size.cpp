// What a model is as a whole: weight, counts, a bound on its frequencies.

#include "taut/plan/stability.hpp"
#include "taut/report/element_rates.hpp"
#include "taut/report/model.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {

double total_weight(const PhysicalModel& model)
{
    double mass = 0;
    for (std::size_t i = 0; i < model.mass.size(); ++i)
        mass += model.pinned[i] ? 0 : model.mass[i];
    return mass * glm::length(model.gravity);
}

std::size_t rigid_element_count(const PhysicalModel& model)
{
    const auto rigid = [](const auto& element) { return !(element.compliance > 0); };
    return static_cast<std::size_t>(std::count_if(model.springs.begin(), model.springs.end(), rigid) +
                                    std::count_if(model.hinges.begin(), model.hinges.end(), rigid) +
                                    std::count_if(model.volumes.begin(), model.volumes.end(), rigid) +
                                    std::count_if(model.surfaces.begin(), model.surfaces.end(), rigid));
}

double frequency_bound(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    const std::size_t count = model.mass.size();
    std::vector<double> thin = stiffness_rows(model.springs, model.hinges, count, x);
    if (!model.plates.empty())
    {
        std::vector<BendElement> bounds;
        for (const PlateHinge& h : model.plates)
            bounds.push_back(h.element);
        const std::vector<double> more = stiffness_rows({}, bounds, count, x);
        for (std::size_t v = 0; v < count; ++v)
            thin[v] += more[v];
    }
    std::vector<double> thick(count, 0.0);
    for (const VolumeElement& e : model.volumes)
        reference::add_stiffness(e, x, thick);
    for (const SolidElement& e : model.solids)
        reference::add_stiffness(e, x, thick);
    for (const SurfaceElement& e : model.surfaces)
        reference::add_stiffness(e, x, thick);
    for (const GasElement& gas : model.gases)
        add_stiffness(gas, x, thick);
    double most = 0;
    for (std::size_t v = 0; v < count; ++v)
        if (!model.pinned[v])
            most = std::max(most, (thin[v] + kStiffening * thick[v]) / model.mass[v]);
    return std::sqrt(most);
}

std::size_t element_cost(const PhysicalModel& model)
{
    std::size_t out = model.springs.size() + 12 * (model.hinges.size() + model.plates.size()) +
                      6 * model.volumes.size() + 10 * model.solids.size() + model.mass.size();
    for (const SurfaceElement& e : model.surfaces)
        out += 3 * e.triangles.size();
    for (const GasElement& gas : model.gases)
        out += 3 * gas.triangles.size();
    return out;
}

} // namespace taut
