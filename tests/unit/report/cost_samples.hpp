#pragma once
// Scenes, options and tables of tests of studies of accuracy against cost.

#include "support/scenes.hpp"
#include "taut/report/cost.hpp"

namespace samples {

/// Six links that come to rest soon; each stretches by some per cent under the weight below it.
inline taut::Scene damped_chain()
{
    taut::Scene scene = taut::test::chain(6, 200, 0.05, 0.6);
    scene.damping = 6;
    return scene;
}

/// The same, let go without damping.
inline taut::Scene free_chain()
{
    taut::Scene scene = damped_chain();
    scene.damping = 0;
    scene.duration = 0.2;
    return scene;
}

inline taut::CostOptions only(std::vector<std::uint32_t> substeps, std::vector<std::uint32_t> iterations,
                              std::vector<taut::Precision> precisions)
{
    taut::CostOptions options;
    options.substeps = std::move(substeps);
    options.iterations = std::move(iterations);
    options.precisions = std::move(precisions);
    options.timing_seconds = 0; // one repetition
    return options;
}

inline taut::CostStudy study_of(const taut::Scene& scene, const taut::CostOptions& options)
{
    return taut::run_cost(scene, taut::Device::open("cpu:serial"), options);
}

inline taut::CostPoint made(std::uint32_t substeps, std::optional<double> error, double ms)
{
    taut::CostPoint point;
    point.substeps = substeps;
    point.error = error;
    point.ms = ms;
    return point;
}

inline taut::CostStudy table(std::vector<taut::CostPoint> points, double own_error = 0)
{
    taut::CostStudy study;
    study.metric = "e_disp";
    study.reference.name = "R2";
    study.reference.error = own_error;
    study.points = std::move(points);
    rank(study);
    return study;
}

} // namespace samples
