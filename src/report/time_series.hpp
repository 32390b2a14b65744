#pragma once
// What changes over the time of a run, sampled at some of its frames.

#include "taut/plan/material.hpp"
#include "taut/report/model.hpp"
#include "taut/report/report.hpp"

#include <optional>
#include <span>
#include <vector>

namespace taut {

/// One frame of a run. Empty: the method has no such thing.
struct TimeSample
{
    std::uint64_t frame = 0;
    double time = 0;                                     ///< s
    double max_stretch = 0;                              ///< largest_stretch()
    std::optional<double> active_share = {};             ///< acad, as World::active_share
    std::optional<std::uint64_t> linear_iterations = {}; ///< of all solves since the sample before
    std::optional<double> volume = {};                   ///< VolumeReport::ratio; of scenes with volumes
};

/// Samples of one run, evenly spread. A run of any length has at most 2 kSamples + 1 of them.
class TimeSeries
{
public:
    static constexpr std::uint64_t kSamples = 60;

    explicit TimeSeries(std::uint64_t frames)
        : every_(frames < kSamples ? 1 : frames / kSamples),
          last_(frames)
    {}

    /// Whether a sample is to be taken after so many frames: at the start, every so often, and at its end.
    bool due(std::uint64_t frame) const { return frame % every_ == 0 || frame == last_; }

    /// `active_share` as World::active_share; `solved`: what the linear solves of the run came to so far,
    /// empty under methods without any. `volume`: as TimeSample::volume.
    void add(std::uint64_t frame, double time, double max_stretch, double active_share,
             const std::optional<SolverReport>& solved, const std::optional<double>& volume = {});

    const std::vector<TimeSample>& list() const { return list_; }

private:
    std::uint64_t every_, last_, iterations_ = 0;
    std::vector<TimeSample> list_;
};

/// The springs of all bodies of a resolved scene, vertices scene-wide.
std::vector<StretchElement> scene_springs(const Scene& resolved);

/// What can stretch in a resolved scene.
struct Stretchable
{
    std::vector<StretchElement> springs;
    std::vector<AddedElement> elements;
};
Stretchable stretchable(const Scene& resolved);

/// Largest (l - L)/L, signed, of springs and within elements that have stretches; springs without a length
/// are left out. 0 without any. `x`: m, scene-wide.
double largest_stretch(std::span<const StretchElement> springs, std::span<const glm::dvec3> x,
                       std::span<const AddedElement> elements = {});

} // namespace taut
