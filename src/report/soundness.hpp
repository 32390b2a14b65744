#pragma once
// Whether a run can be believed, judged by physics: energy against what can have been put in, strain, clamped
// speeds, inverted elements. docs/statuses.md says how each bound was chosen.

#include "taut/report/energy_budget.hpp"
#include "taut/runtime/base/status.hpp"

#include <span>
#include <string>

namespace taut {

/// A state of a run, to be judged. Spans are of all vertices of `scene`. `events` and `vertex_substeps`: 0
/// where others judge them.
struct RunState
{
    const Scene& scene; ///< resolved, as it is now
    std::span<const glm::dvec3> x, v; ///< m, m/s
    WorldDrive drive;
    Precision precision = Precision::float32;
    Events events;
    double vertex_substeps = 0; ///< vertices times substeps so far
    std::span<const Collider> colliders = scene.colliders; ///< that its bodies meet
};

struct Soundness
{
    Status status = Status::completed; ///< or unconverged, diverged, non_finite
    std::string reason;                ///< a sentence with the numbers; empty when completed
    double energy = 0;                 ///< J: kinetic, and of elements strained beyond accept.stretch
    double energy_most = 0;            ///< J: EnergyBudget::most
    bool energy_exact = false;         ///< EnergyMost::exact

    bool sound() const { return status == Status::completed; }
};

/// How bad: 0 completed, 1 unconverged, 2 diverged, 3 anything else but an interruption.
int rank(Status status);

/// The worse of two; of two that are as bad, the first.
Soundness worse(const Soundness& a, const Soundness& b);

/// Factors of EnergyBudget::most: kinetic energy beyond the first, kinetic and strained energy beyond the
/// third is `diverged`; kinetic and strained energy beyond the second is `unconverged`.
inline constexpr double kDivergedKinetic = 2, kUnconvergedEnergy = 1.5, kDivergedEnergy = 100;
/// Share of all energy that sweeps may leave as motion in what pins hold drawn.
inline constexpr double kNoiseOfStrain = 1e-3;
/// Beyond this factor of it the energy of tetrahedra strained beyond this share of accept.stretch is
/// `unconverged`.
inline constexpr double kSlightEnergy = 3, kSlightStrain = 0.1;
/// Coordinates beyond this count as diverged, m.
inline constexpr double kDivergedExtent = 1e12;
/// Share of vertices times substeps whose speed was cut at the scene's own max_speed.
inline constexpr double kClampedShare = 0.01;
/// Share of springs times substeps that implicit_constraints counts as turned.
inline constexpr double kTurnedShare = 0.05;

/// Speeds cut at the scene's max_speed, or by the guard against overflow where it has none, of so many
/// vertices times substeps.
Soundness judge_clamps(const Scene& scene, const Events& events, double vertex_substeps);

/// That, and displacements that were not finite.
Soundness judge_counts(const Scene& scene, const Events& events, double vertex_substeps);

/// What moves too fast, is too far away or not finite. Costs a pass over the vertices.
Soundness judge_motion(const EnergyBudget& budget, const RunState& state);

/// That, and what is strained or inverted. Costs a pass over the elements.
Soundness judge_state(const EnergyBudget& budget, const RunState& state);

enum class Judged
{
    motion, ///< by judge_motion
    state,  ///< by judge_state
};

} // namespace taut
