#pragma once
// What accuracy costs: one scene under many settings of one or several methods, each with its error against
// a reference, its time and its work (docs/cost.md).

#include "taut/plan/methods.hpp"
#include "taut/report/continuum.hpp"
#include "taut/report/cost_contact.hpp"
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

/// What a scene moves by in a second at rest, of its displacement.
inline constexpr double kRestTolerance = 1e-5;

/// What "cheaper" means.
enum class CostBasis
{
    wall,  ///< median wall time
    cpu,   ///< process time: steadier on a busy machine; wall time on devices that have none
    sweeps ///< machine-independent work
};

struct CostOptions
{
    std::vector<MethodKind> methods{MethodKind::xpbd};
    /// Each method's own design (cost_design.hpp) instead of substeps x iterations.
    bool designed = false;
    CostBasis basis = CostBasis::wall;
    std::vector<std::uint32_t> substeps{1, 2, 5, 10, 20, 50}; ///< 1..1000 each
    std::vector<std::uint32_t> iterations{1, 2, 5, 10};       ///< 1..1000 each
    std::vector<Precision> precisions{Precision::float32, Precision::float64};
    CostKind kind = CostKind::automatic;
    /// Moving: frames compared at most; 0 = the scene's duration. A reference may verify fewer.
    std::size_t frames = 0;
    double rest_seconds = 30;       ///< at rest: simulated s at most until it must rest
    double rest_tolerance = kRestTolerance; ///< at rest: of the displacement, over a simulated second, 0..0.1
    std::optional<double>
        linear_tolerance;           ///< of every linear solve, (0, 1); empty: the scene's and the design's
    std::size_t repeats = 10;       ///< timed repetitions of a setting, in turns with all others; 1..1000
    double timing_seconds = 2;      ///< wall s after which no further repetition of a setting starts
    double reference_steps = 1.5e9; ///< element steps of R3 at most; a core does about 1e8 a second
    bool self_reference = true;     ///< whether R4 may be taken where R2 and R3 refuse
    std::vector<MethodKind> refined; ///< for R4; empty: with one method under test that one, else the usual
    /// R4 of a motion: its own error that will do, as e_traj: substeps are doubled until it is reached. 0: as
    /// fine as 400 substeps.
    double reference_error = 0;
    std::uint32_t coarsest = 0; ///< R4 with a reference_error: substeps that it begins with at least
    /// At rest: beside every error also that against the continuum. One with a reason is as none.
    std::optional<ContinuumReference> continuum;
    /// The part of the time for a reference that is gone: from 1 on it ends, and what is verified until then
    /// is taken. Empty: there is no limit.
    std::function<double()> spent;
    /// Called before each setting; false stops, and what is left is a gap.
    std::function<bool(std::size_t done, std::size_t total)> progress;
};

/// What errors are measured against.
struct CostReference
{
    /// "R2", "R3", "R4 (self-convergence, same method)", "R4 (self-convergence of vbd)", "none"
    std::string name = "none";
    std::string text;                ///< one sentence: what it is and how far to trust it
    std::vector<std::string> passed; ///< why stronger classes were not taken
    bool verified = false;
    std::optional<double> error;                 ///< estimate of its own error, in the metric of the study
    std::optional<double> error_l;               ///< the same as e_L
    std::vector<double> errors;      ///< `error` of the frames up to each; empty where there is none
    std::vector<MethodKind> methods; ///< R4: what was taken, and what confirms it
    std::uint32_t substeps = 0;      ///< R4: of its finest run
    double times = 0; ///< none, for lack of time: so many times the time for it may have one; else 0
    std::vector<std::vector<glm::dvec3>> frames; ///< moving: start and every frame; at rest: start and rest
};

/// One setting. Without `error` it is a gap and `reason` says why.
struct CostPoint
{
    std::string method = "xpbd";
    std::uint32_t substeps = 1, iterations = 1;
    Precision precision = Precision::float32;
    MethodSettings settings; ///< all of them
    /// The word of the Error by which the method refused: "unsupported", "unstable_timestep", ...; else
    /// empty.
    std::string refused;
    /// What of the scene's material the method replaces by one of its own, as `tune` says it; else empty.
    std::string other_material;
    Status status = Status::completed;
    std::string reason;
    std::optional<double> error;          ///< in the metric of the study
    std::optional<double> error_l;        ///< e_L at the last frame
    std::optional<double> error_smoothed; ///< e_traj of moving averages over six frames
    std::optional<double> error_continuum; ///< e_disp against R1
    std::optional<cost::ContactError> contact; ///< where surfaces push each other
    bool at_floor = false;                ///< error below 10 times the reference's own: not told apart
    double simulated_seconds = 0;         ///< until the error was taken
    double ms = 0, ms_least = 0;          ///< per simulated second, wall: median and least of the repetitions
    std::optional<double> cpu_ms;         ///< the same in process time, median; software devices only
    double ms_low = 0, ms_high = 0, cpu_low = 0,
           cpu_high = 0; ///< first and third quartile of the repetitions
    std::string floor;   ///< words of the floors that its error is below (CostFloor), joined by blanks
    std::size_t repetitions = 0;
    double sweeps = 0;   ///< per simulated second; one visit of every constraint = 1
    bool pareto = false; ///< no other setting is cheaper and more accurate
};

/// Below it an error says nothing of the method; below "mesh" it is wasted.
struct CostFloor
{
    std::string word;  ///< "reference", "rest", "mesh", "linear_tolerance", "float", "double"
    double error = 0;  ///< in the metric of the study
    std::string words; ///< for people
};

struct CostTarget
{
    double tolerance = 0;                ///< 0.1, 0.01, 0.001
    std::optional<std::size_t> cheapest; ///< index of the point; empty when not reached
    std::optional<std::size_t> own;      ///< the same of those that have the scene's material
};

/// How one method fares.
struct CostMethod
{
    std::string name;
    std::vector<CostTarget> targets;
    std::string refused; ///< why, when it refused every setting; else empty
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
    /// CostOptions::continuum; with a reason where it cannot be trusted, or is of another place of rest.
    std::optional<ContinuumReference> continuum;
    CostBasis basis = CostBasis::wall;
    double rest_tolerance = kRestTolerance;
    std::vector<CostPoint> points; ///< method, then precision; with lists then iterations, then substeps
    std::vector<CostTarget> targets;
    std::vector<CostMethod> methods; ///< in the order of points
    bool interrupted = false;

    /// What surfaces do to each other in the reference: of what moves on the way, at rest in a second more.
    /// None where none push each other, and under R2 and R3, which know no contact.
    std::optional<cost::ContactTrace> contact;

    /// At least one point has an error.
    bool sound() const;
    bool has_continuum() const { return continuum && continuum->reason.empty(); }
};

/// Whether every body is held by pins that stand still.
bool held_still(const Scene& scene);
/// At rest: every body held by pins that stand still, no colliders, and damping that brings it there.
CostKind cost_kind(const Scene& scene);

/// Throws Error{bad_input} for empty or impossible lists and for a continuum of what moves or of another
/// scene, and what World throws for every setting alike.
CostStudy run_cost(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options = {});

/// Ten times the reference's own error; at rest the rest test; with a continuum the mesh's error; of methods
/// with linear solves the tolerance of those; one rounding of float and of double. `point` null: all of the
/// study, else those of the point.
std::vector<CostFloor> cost_floors(const CostStudy& study, const CostPoint* point = nullptr);
/// Those of a study for its figures: shaded are the ones that hold for every point.
std::vector<PlotFloor> plot_floors(const CostStudy& study);

/// What a point costs on that basis.
double price(const CostPoint& point, CostBasis basis);

/// Sets pareto and at_floor of every point, and the targets, of all methods and of each. Errors within the
/// reference's floor count as equal, so that only the cheapest of them is on the front.
void rank(CostStudy& study);

/// Three sentences: the cheapest setting for 10 %, 1 % and 0.1 %. With several methods they name the method.
/// Where the cheapest is of another material they say so, and name the cheapest that is not. With a continuum
/// a fourth: from which setting on more work is lost on the mesh.
std::vector<std::string> cost_sentences(const CostStudy& study);
/// "20 substeps x 1 iteration in float"
std::string setting_text(const CostPoint& point);
/// Method by tolerance: what the cheapest setting costs and how many sweeps it makes, "-" where no setting
/// reaches it, "R" where the method refused all. Rows of cells, the first is the head.
std::vector<std::vector<std::string>> cost_table(const CostStudy& study);

std::string cost_json(const CostStudy& study); ///< one object, indented
std::string cost_csv(const CostStudy& study);  ///< a head and one row a point; gaps have empty fields
enum class CostAxis
{
    time, ///< on the study's basis, if that is a time
    sweeps
};
/// Work-precision diagram. With several methods each has one line, through its own front.
Plot cost_plot(const CostStudy& study, CostAxis axis);

enum class CostSplit
{
    substeps,  ///< varied, at fixed iterations
    iterations ///< varied, at fixed substeps
};
/// The errors of one method and its own choices along one axis.
struct CostOrder
{
    std::string name;              ///< "mass_spring, integrator verlet"
    std::string method;
    std::uint32_t fixed = 1;       ///< the other count: the one with the most points
    std::vector<PlotPoint> points; ///< x = count, y = error, ascending in x; gaps are left out
    /// Observed: mean of the last two slopes between errors below 50 % and above the reference's floor,
    /// before more of the same stops helping.
    std::optional<double> order;
    bool at_floor = false; ///< the last slopes are below 0.1, or up again: more of the same does not help
};
/// Families with at least two errors.
std::vector<CostOrder> convergence(const CostStudy& study, CostSplit split);
/// The same as a diagram, orders in the caption.
Plot convergence_plot(const CostStudy& study, CostSplit split);

} // namespace taut
