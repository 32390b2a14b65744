#pragma once
// Scenes and options of tests of the search for the cheapest setting. Prices are priors, so nothing depends
// on the machine's speed.

#include "support/scenes.hpp"
#include "taut/report/tune.hpp"

namespace samples {

inline std::shared_ptr<taut::Device> serial() { return taut::Device::open("cpu:serial"); }

/// A chain that swings from the side; nothing brings it to rest.
inline taut::Scene swinging(std::uint32_t links, double stiffness, double mass)
{
    taut::Scene scene = taut::test::chain(links, stiffness, mass, 0.6);
    scene.name = "swinging";
    scene.bodies[0].velocity = {0.5, 0, 0.2};
    scene.duration = 0.4;
    return scene;
}

/// A chain that comes to rest.
inline taut::Scene resting(std::uint32_t links, double stiffness, double mass)
{
    taut::Scene scene = taut::test::chain(links, stiffness, mass, 0.6);
    scene.name = "resting";
    scene.damping = 6;
    return scene;
}

inline taut::Scene sheet(std::uint32_t cells, double stiffness)
{
    taut::Scene scene = taut::test::hanging(cells);
    scene.name = "sheet";
    scene.bodies[0].material.stretch_stiffness = stiffness;
    scene.duration = 0.25;
    return scene;
}

inline taut::TuneOptions by_prior(double error)
{
    taut::TuneOptions options;
    options.error = error;
    options.prior_only = true;
    options.precisions = {taut::Precision::float32};
    options.reference_steps = 2e8;
    options.rest_seconds = 10;
    return options;
}

} // namespace samples
