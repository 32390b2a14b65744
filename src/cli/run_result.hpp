#pragma once
// What `taut run` found out, and how it prints that.

#include "taut/cli/output.hpp"
#include "taut/report/crossing.hpp"
#include "taut/report/time_series.hpp"
#include "taut/world/hybrid.hpp"

#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

struct RunResult
{
    std::string scene;  ///< as given
    std::string folder; ///< as given or chosen
    DeviceInfo device;
    DeviceCounters counters; ///< of the device at the end
    Precision precision = Precision::float32;
    std::uint64_t frames = 0; ///< done, one time step each
    std::uint64_t frames_wanted = 0;
    std::uint64_t vertices = 0;
    std::map<std::string, std::uint64_t> constraints, colours; ///< by kind
    std::size_t solvers = 0; ///< linear systems of a step
    StepReport report;
    Crossings crossings; ///< of bodies and colliders, over the run
    std::vector<std::string_view> energy_takers; ///< energy_takers() of the scene
    std::vector<TimeSample> series; ///< of methods that solve linear systems
    double volume_min = 1; ///< smallest V / V0 of all frames, of scenes with solids
    std::vector<double> step_ms;       ///< wall time of each frame, ms
    std::vector<EffectTime> passes;    ///< device time of one frame by effect; empty after an interruption
    std::vector<std::string> messages; ///< what scene and plan warn of, in sentences
    std::size_t meshes = 0;            ///< files written
    std::optional<std::size_t> asleep; ///< bodies at the end, where they may sleep
    std::vector<HybridPart> parts;     ///< of a hybrid run: what each device did
    std::vector<std::string> pictures; ///< files written, relative to the folder
};

/// What a device holds and has taken for it: {buffers, reserved, blocks}, and the line for people.
Json memory_json(const DeviceCounters& counters);
std::string memory_line(const DeviceCounters& counters);

/// The keys are documented in docs/program.md.
Json series_json(const std::vector<TimeSample>& series);
Json to_json(const RunResult& result);

/// For people: a few lines.
std::string summary(const RunResult& result);

} // namespace taut::cli
