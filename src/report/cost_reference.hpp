#pragma once
// Which reference a study is measured against.

#include "taut/report/cost_trial.hpp"
#include "taut/report/model.hpp"

namespace taut::cost {

struct CostInput
{
    const Scene& scene; ///< resolved
    const PhysicalModel& model;
    const ErrorWeights& weights;
    const CostOptions& options;
    std::shared_ptr<Device> device;
};

/// What a scene has that the model of R1, R2 and R3 does not know; empty when there is nothing.
std::string unmodelled(const Scene& scene);

/// R2, else R4. The states are the start and the state at rest.
CostReference reference_at_rest(const CostInput& input);
/// R3, else R4, over as many frames as are verified.
CostReference reference_of_motion(const CostInput& input);

/// Whether no more time is to be spent on references.
bool enough(const CostInput& input);

/// Frames that a moving study wants.
std::size_t wanted_frames(const Scene& scene, const CostOptions& options);

/// How far a sequence of three refinements can be trusted.
struct Refinement
{
    std::size_t frames = 0; ///< of the first unbroken stretch that converges
    double order = 0;       ///< observed
    double error = 0;       ///< of the finest, estimated, as e_traj
    double error_l = 0;     ///< the same as e_L at the last of these frames
    std::vector<double> errors; ///< `error` of the frames up to each
};
/// What counts as convergence.
struct RefineRule
{
    double lowest = 0.7, highest = 2.3; ///< observed order
    double share = 0;                   ///< of the last difference that the error is at least
    /// Frames that do not converge may lie between, if three in a row do after them: a contact that begins
    /// weighs much in what has hardly moved, and little later on.
    bool rejoins = false;
};
/// Coarse, half the step, a quarter of it. Converges: an observed order by the rule, and a last difference
/// below 5 % of the motion or of rounding (1e-14 of the size).
Refinement refine(const ErrorWeights& weights, const Frames& coarse, const Frames& half,
                  const Frames& quarter, const RefineRule& rule = {});

} // namespace taut::cost
