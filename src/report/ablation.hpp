#pragma once
// What each effect of a scene costs: the scene without it beside the whole scene, in one run (figure F9).

#include "taut/runtime/device.hpp"
#include "taut/scene/scene.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace taut {

struct AblationRow
{
    std::string effect;           ///< that is missing; empty: the whole scene
    double step_ms = 0; ///< median time of a step, waiting included: CPU time on software devices, else wall
    double cost_ms = 0;           ///< of the whole scene less step_ms
    std::int64_t dispatches = 0;  ///< a step, of the whole scene less this
    std::int64_t bytes = 0;       ///< allocated, likewise
    std::int64_t bytes_moved = 0; ///< a step, likewise; an upper bound
    double difference = 0; ///< e_L of the last frame from that of the whole scene: what the effect does
    std::string refusal;   ///< why the scene cannot be without it; the rest is then 0
};

struct Ablation
{
    std::string scene;
    DeviceInfo device;
    std::uint64_t frames = 0;
    std::vector<AblationRow> rows; ///< the whole scene first, then one an effect in the order of a step
};

/// Runs the scene and its variants step by step in turns, so that a disturbance meets all of them. "motion"
/// stays: nothing moves without it. `progress` is asked after every frame whether to go on; may be empty.
/// Throws what World throws for the whole scene.
Ablation run_ablation(const Scene& resolved, std::shared_ptr<Device> device, std::uint64_t frames,
                      const std::function<bool(std::size_t done, std::size_t total)>& progress = {});

std::string ablation_markdown(const Ablation& ablation);
std::string ablation_csv(const Ablation& ablation);

} // namespace taut
