#pragma once
// How a run went, as values: statuses, errors of measure, energies, residuals.

#include "taut/report/soundness.hpp"
#include "taut/report/volume.hpp"
#include "taut/runtime/base/status.hpp"
#include "taut/world/world.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// Warnings: something a user should know though the run is sound. With their count.
enum class Warning
{
    degenerate,
    speed_clamp,
    conflict,
    precision,
    iteration_limit,
    solve_failed,
    unconverged,
    tunnelling,
    may_tunnel,
    soft
};
std::string_view to_string(Warning warning);

/// One look at a world. Lengths in m, energies in J, computed in fp64 on the host.
struct StepReport
{
    Status status = Status::completed;
    std::string reason; ///< why it is not completed; a sentence
    std::map<std::string, std::uint64_t> warnings;
    std::uint64_t step = 0;
    double time = 0;
    bool springs = false;        ///< there are any, or membranes: else there is no stretch to speak of
    /// Largest (l-L)/L, signed, over distance constraints, and over the directions within each membrane.
    double max_stretch = 0;
    double rms_stretch = 0;      ///< root mean square of max(0, (l-L)/L)
    double penetration = 0;      ///< deepest vertex below a collider's surface, m
    double kinetic_energy = 0;
    double potential_energy = 0; ///< gravity + elastic, zero of gravity at the origin
    double judged_energy = 0;    ///< J, kinetic and of what is strained beyond accept.stretch (soundness.hpp)
    double energy_most = 0;      ///< J, that physics can have put into it
    std::optional<double> energy_lost; ///< J, where it can be told (energy_lost.hpp)
    /// |P - P0 - impulse| / (M v), v the largest of the root mean square of the speeds now and at the start,
    /// sqrt(g D) and what rounding of places makes; -1 where pins, colliders, max_speed or others take or
    /// give momentum.
    double momentum_error = 0;
    /// methods: ||M(x - x~) - J^T lambda|| / (m g h^2), -1 without multipliers; implicit_euler: r_acc
    double primal_residual = 0;
    /// max |C + alpha/h^2 lambda| / L, L at rest or as the spring should be now, whichever is longer; -1
    /// without multipliers
    double dual_residual = 0;
    double stretch_residual = -1; ///< that of the distance constraints alone
    double flow_residual = -1; ///< that of those whose plastic rest length has changed, over their yield
    /// What the last substep left of all forces, added up by size, over those at hand (inertia, weight, those
    /// of every element): 0 solved, at least 1/2 nothing done; -1 where primal_residual is.
    double imbalance = -1;
    /// What one exact Newton step would still move of the worst body's mass after the last substep, over what
    /// its loads (weight, inertia) move in a substep; of a body that touches something half of that,
    /// counted away from there (report/load_residual.hpp): 0 solved, 1 as if nothing pulled. Vertices of
    /// plastic bodies are held. Dear, so that residuals_ahead() measures it and measure() leaves -1; -1 also
    /// under other methods, and where all bodies are plastic or have elements of which nothing can be said
    /// (rigid ones, attachments, held surface volumes).
    double load_residual = -1;
    /// xpbd: what the leftovers of its substeps move the worst body in the time of a fall through the scene's
    /// size, over the body's size; load_residual is then what they move over what its loads do.
    double load_way = 0;
    double max_speed = 0;        ///< m/s
    double active_share = -1; ///< acad: share of springs that were constraints in the last substep, or -1
    SolverReport solver;         ///< of the run so far
    VolumeReport volume;         ///< of bodies with tetrahedra
    ContactCounts contacts;      ///< of surfaces that meet
    std::vector<BodyContactForce> contact_forces; ///< of bodies that push each other
    double contact_depth = 0;    ///< m: by how much the nearest pair of surfaces is nearer than it is kept
    std::uint64_t torn = 0;      ///< vertices that came apart so far
    std::uint64_t position_hash = 0; ///< FNV-1a over the raw position and low words in plan order
};

StepReport measure(const World& world);

/// Of momentum_error: beyond it a run is `unconverged`.
inline constexpr double kMomentumShare = 0.1;
/// ContactCounts::held a vertex and substep: beyond it a run is `unconverged` (docs/statuses.md).
inline constexpr double kHeldShare = 0.1;
/// StepReport::flow_residual: of cloth that pins draw beyond its yield 0.95 leaves 0.42 of the energy, 0.44
/// leaves 0.75, 0.10 leaves 0.95 (docs/statuses.md).
inline constexpr double kFlowShare = 0.25;

/// Makes a report's status and reason those found, where that is worse.
void set_status(const Soundness& found, StepReport& report);

/// The same with residuals of the report beyond what the scene accepts, but for load_residual: a step on the
/// way may leave loads to the next one, so that it is judged where a run ends (report/residuals.hpp).
void judge_residuals(const Scene& scene, StepReport& report);

} // namespace taut
