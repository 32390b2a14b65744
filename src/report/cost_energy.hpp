#pragma once
// What each method does to energy and momentum where both should be kept (docs/cost.md).

#include "taut/report/cost.hpp"

#include <memory>
#include <string>
#include <vector>

namespace taut {

/// One setting over time.
struct EnergyRun
{
    MethodSettings settings;
    std::vector<double> energy; ///< (E - E(0)) / E_ref at each frame, the first is 0; signed
    std::vector<double>
        momentum;       ///< StepReport::momentum_error; empty where pins or contacts make it undefined
    std::string reason; ///< why it ended early, or did not run
};

struct EnergyStudy
{
    std::string scene;
    double timestep = 0;
    /// J: the most kinetic energy that any run had, at least what the bodies start with.
    double reference_energy = 0;
    std::vector<EnergyRun> runs;
};

/// Every setting of `options` (its methods, lists or designs, precisions), as many frames as it says, or the
/// scene's. Throws Error{bad_input} for a scene with damping, colliders or pins that move: there energy is
/// not kept.
EnergyStudy run_energy(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options);

/// setting, time s, energy, momentum
std::string energy_csv(const EnergyStudy& study);
enum class Conserved
{
    energy,
    momentum
};
/// |drift| against time, both logarithmic; zeros are left out.
Plot energy_plot(const EnergyStudy& study, Conserved what);
/// One a run: the last drift with its sign, and the largest error of momentum.
std::vector<std::string> energy_sentences(const EnergyStudy& study);

} // namespace taut
