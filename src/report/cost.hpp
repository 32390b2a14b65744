#pragma once
// What accuracy costs: one scene under many settings of a method, each with its error against a
// reference, its time and its work (docs/cost.md).

#include "taut/report/report.hpp"
#include "taut/report/svg_plot.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace taut {

enum class CostKind
{
    automatic,
    at_rest, ///< run until it rests; e_disp against the static equilibrium
    moving,  ///< e_traj against a trajectory
};

struct CostOptions
{
    std::vector<std::uint32_t> substeps{1, 2, 5, 10, 20, 50}; ///< 1..1000 each
    std::vector<std::uint32_t> iterations{1, 2, 5, 10};       ///< 1..1000 each
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
    CostKind kind = CostKind::automatic;
    /// Moving: frames compared at most; 0 = the scene's duration. A reference may verify fewer.
    std::size_t frames = 0;
    double rest_seconds = 30;       ///< at rest: simulated s at most until it must rest
    double timing_seconds = 2;      ///< wall s after which no further repetition of a setting starts
    double reference_steps = 1.5e9; ///< element steps of R3 at most; a core does about 1e8 a second
    /// Called before each setting; false stops, and what is left is a gap.
    std::function<bool(std::size_t done, std::size_t total)> progress;
};

/// What errors are measured against.
struct CostReference
{
    std::string name = "none";       ///< "R2", "R3", "R4 (self-convergence, same method)", "none"
    std::string text;                ///< one sentence: what it is and how far to trust it
    std::vector<std::string> passed; ///< why stronger classes were not taken
    bool verified = false;
    std::optional<double> error;                 ///< estimate of its own error, in the metric of the study
    std::optional<double> error_l;               ///< the same as e_L
    std::vector<std::vector<glm::dvec3>> frames; ///< moving: start and every frame; at rest: start and rest
};

/// One setting. Without `error` it is a gap and `reason` says why.
struct CostPoint
{
    std::string method = "xpbd";
    std::uint32_t substeps = 1, iterations = 1;
    Precision precision = Precision::float32;
    Status status = Status::completed;
    std::string reason;
    std::optional<double> error;          ///< in the metric of the study
    std::optional<double> error_l;        ///< e_L at the last frame
    std::optional<double> error_smoothed; ///< e_traj of moving averages over six frames
    bool at_floor = false;                ///< error below 10 times the reference's own: not told apart
    double simulated_seconds = 0;         ///< until the error was taken
    double ms = 0, ms_least = 0;          ///< per simulated second, wall: median and least of the repetitions
    std::optional<double> cpu_ms;         ///< the same in process time, median; software devices only
    std::size_t repetitions = 0;
    double sweeps = 0;   ///< per simulated second; one visit of every constraint = 1
    bool pareto = false; ///< no other setting is cheaper and more accurate
};

struct CostTarget
{
    double tolerance = 0;                ///< 0.1, 0.01, 0.001
    std::optional<std::size_t> cheapest; ///< index of the point; empty when not reached
};

struct CostStudy
{
    std::string scene;
    DeviceInfo device;
    CostKind kind = CostKind::moving;
    std::string metric; ///< "e_disp", "e_traj"; "e_L" when the reference does not move
    std::size_t vertices = 0, constraints = 0;
    double timestep = 0;
    std::size_t frames = 0; ///< moving: compared
    CostReference reference;
    std::vector<CostPoint> points; ///< precision, then iterations, then substeps
    std::vector<CostTarget> targets;
    bool interrupted = false;

    /// At least one point has an error.
    bool sound() const;
};

/// At rest: every body held by pins that stand still, no colliders, and damping that brings it there.
CostKind cost_kind(const Scene& scene);

/// Throws Error{bad_input} for empty or impossible lists, and what World throws for every setting alike.
CostStudy run_cost(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options = {});

/// Sets pareto and at_floor of every point, and the targets. Errors within the reference's floor count as
/// equal, so that only the cheapest of them is on the front.
void rank(CostStudy& study);

/// Three sentences: the cheapest setting for 10 %, 1 % and 0.1 %.
std::vector<std::string> cost_sentences(const CostStudy& study);
/// "20 substeps x 1 iteration in float"
std::string setting_text(const CostPoint& point);

std::string cost_json(const CostStudy& study); ///< one object, indented
std::string cost_csv(const CostStudy& study);  ///< a head and one row a point; gaps have empty fields
enum class CostAxis
{
    time,
    sweeps
};
/// Work-precision diagram.
Plot cost_plot(const CostStudy& study, CostAxis axis);

} // namespace taut
