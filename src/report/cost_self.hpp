#pragma once
// Class R4 of the references: a method refined until it agrees with itself.

#include "taut/report/cost_reference.hpp"
#include "taut/report/errors.hpp"

#include <string>
#include <vector>

namespace taut::cost {

/// Frames of a first try, and the fewest that make a study.
inline constexpr std::size_t kFirstWindow = 15, kFewest = 6;

/// A method refined until it agrees with itself; `reason` says when it does not.
struct Refined
{
    MethodKind method;
    Refinement found;
    Frames finest; ///< `found.frames` of them are good
    std::string reason;
    std::uint32_t substeps = 0; ///< of the finest run
    double times = 0; ///< so many times its time it would need at least; 0: time is not what it lacks
};

/// The device itself, or the native CPU where that one has no double.
std::shared_ptr<Device> double_device(const CostInput& input);
/// So many substeps of one iteration in double.
MethodSettings fine_settings(const CostInput& input, MethodKind method, std::uint32_t substeps);

/// From a few substeps on, twice as many each time, and no further than CostOptions::reference_error asks.
Refined climb(const CostInput& input, MethodKind method, std::size_t frames);

/// Where a fine run of the method in double comes to rest.
Motion settled_run(const CostInput& input, MethodKind method, std::uint32_t substeps);

/// R4, or none; `passed` says why stronger classes were not taken.
CostReference self_at_rest(const CostInput& input, std::vector<std::string> passed);
CostReference self_motion(const CostInput& input, std::size_t frames, std::vector<std::string> passed);

/// "19 frames (0.32 s)"
std::string frames_text(std::size_t frames, double timestep);

} // namespace taut::cost
