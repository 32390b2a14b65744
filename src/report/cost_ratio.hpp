#pragma once
// What a contrast inside a scene does to each method: errors over growing ratios of masses or stiffnesses,
// at fixed substeps and iterations (docs/cost.md).

#include "taut/report/cost.hpp"

#include <memory>
#include <string>
#include <vector>

namespace taut {

enum class RatioKind
{
    mass,     ///< the last vertex of every body is so many times as heavy
    stiffness ///< springs within the second half of a body's vertices are so many times as stiff
};

/// The scene with that ratio, > 0. Springs of the material become springs of the bodies' own lists.
Scene ratio_scene(const Scene& resolved, RatioKind kind, double ratio);

struct RatioStudy
{
    std::string scene;
    RatioKind kind = RatioKind::mass;
    std::vector<double> ratios;
    std::vector<CostStudy> studies; ///< one a ratio
};

/// 1, 10, ... 1e5 for masses, 1e6 for stiffnesses.
std::vector<double> usual_ratios(RatioKind kind);

/// One study a ratio, each with its own reference. Throws what run_cost throws.
RatioStudy run_ratios(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options,
                      RatioKind kind, const std::vector<double>& ratios);

/// One a method: up to which ratio its error stays within 10 %, and what ends that.
std::vector<std::string> ratio_sentences(const RatioStudy& study);
std::string ratio_csv(const RatioStudy& study); ///< the rows of cost_csv() with the ratio in front
Plot ratio_plot(const RatioStudy& study);       ///< error against ratio, a line for each setting

} // namespace taut
