#pragma once
// How a run went, as values: statuses, errors of measure, energies, residuals.

#include "taut/report/volume.hpp"
#include "taut/runtime/base/status.hpp"
#include "taut/world/world.hpp"

#include <map>
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
    tunnelling,
    may_tunnel
};
std::string_view to_string(Warning warning);

/// One look at a world. Lengths in m, energies in J, computed in fp64 on the host.
struct StepReport
{
    Status status = Status::completed;
    std::map<std::string, std::uint64_t> warnings;
    std::uint64_t step = 0;
    double time = 0;
    double max_stretch = 0;      ///< largest (l-L)/L over distance constraints, signed
    double rms_stretch = 0;      ///< root mean square of max(0, (l-L)/L)
    double penetration = 0;      ///< deepest vertex below a collider's surface, m
    double kinetic_energy = 0;
    double potential_energy = 0; ///< gravity + elastic, zero of gravity at the origin
    double momentum_error =
        0; ///< |P - P0 - impulse| / (M v_ref); NaN is never used: -1 when pins or contacts make it undefined
    /// methods: ||M(x - x~) - J^T lambda|| / (m g h^2), -1 without multipliers; implicit_euler: r_acc
    double primal_residual = 0;
    double dual_residual = 0;    ///< max |C + alpha/h^2 lambda| / L; -1 without multipliers
    double max_speed = 0;        ///< m/s
    double active_share = -1; ///< acad: share of springs that were constraints in the last substep, or -1
    SolverReport solver;         ///< of the run so far
    VolumeReport volume;         ///< of bodies with tetrahedra
    std::uint64_t torn = 0;      ///< vertices that came apart so far
    std::uint64_t position_hash = 0; ///< FNV-1a over the raw position and low words in plan order
};

/// Coordinates beyond this count as diverged, m.
inline constexpr double kDivergedExtent = 1e12;

StepReport measure(const World& world);

} // namespace taut
