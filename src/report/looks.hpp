#pragma once
// What changes over the time of a run, looked at in some of its frames.

#include "taut/plan/material.hpp"
#include "taut/report/model.hpp"
#include "taut/report/report.hpp"

#include <optional>
#include <span>
#include <vector>

namespace taut {

/// One look at a frame. Empty: the method has no such thing.
struct Look
{
    std::uint64_t frame = 0;
    double time = 0;                                ///< s
    double max_stretch = 0;                         ///< largest_stretch()
    std::optional<double> active_share = {};        ///< acad, as World::active_share
    std::optional<std::uint64_t> linear_iterations = {}; ///< of all solves since the look before
    std::optional<double> volume = {};                   ///< VolumeReport::ratio; of scenes with volumes
};

/// The looks at one run. A run of any length has at most 2 kLooks + 1 of them.
class Looks
{
public:
    static constexpr std::uint64_t kLooks = 60;

    explicit Looks(std::uint64_t frames) : every_(frames < kLooks ? 1 : frames / kLooks), last_(frames) {}

    /// Whether the run is looked at after so many frames: at the start, every so often, and at its end.
    bool due(std::uint64_t frame) const { return frame % every_ == 0 || frame == last_; }

    /// `active_share` as World::active_share; `solved`: what the linear solves of the run came to so far,
    /// empty under methods without any. `volume`: as Look::volume.
    void add(std::uint64_t frame, double time, double max_stretch, double active_share,
             const std::optional<SolverReport>& solved, const std::optional<double>& volume = {});

    const std::vector<Look>& list() const { return list_; }

private:
    std::uint64_t every_, last_, iterations_ = 0;
    std::vector<Look> list_;
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
