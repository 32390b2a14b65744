#pragma once
// Errors of measure against a reference, mass-weighted over the vertices that move (docs/measures.md).
// Relative measures are empty where their denominator is zero: print the absolute ones beside them.

#include "taut/report/model.hpp"

#include <optional>
#include <span>
#include <vector>

namespace taut {

using Positions = std::span<const glm::dvec3>;       ///< m, one a vertex
using Frames = std::vector<std::vector<glm::dvec3>>; ///< frame 0 is the start

/// What errors are weighed by.
struct ErrorWeights
{
    std::vector<double> mass; ///< kg; 0 = a vertex that does not count
    double diameter = 0;      ///< m, > 0
};

/// The moving vertices with their masses, and the diagonal of the rest box.
ErrorWeights error_weights(const PhysicalModel& model);

/// sqrt(sum m |a - b|^2), m kg^1/2.
double distance_by_mass(const ErrorWeights& weights, Positions a, Positions b);

/// e_disp = |x - x*|_M / |x* - x_0|_M. Empty when the reference did not move.
std::optional<double> displacement_error(const ErrorWeights& weights, Positions x, Positions reference,
                                         Positions start);

/// e_L = max |x - x*| / D: what an eye sees.
double largest_error(const ErrorWeights& weights, Positions x, Positions reference);
/// The same over all frames.
double largest_error(const ErrorWeights& weights, const Frames& x, const Frames& reference);

/// e_traj = sqrt(sum_frames |x - x*|_M^2 / sum_frames |x* - x*_0|_M^2). Only modes with a period of 20
/// frames or more make sense here; smooth both first where there are faster ones. Same frame counts.
std::optional<double> trajectory_error(const ErrorWeights& weights, const Frames& x, const Frames& reference);

/// Moving average over `window` frames; window - 1 frames shorter. The first frame stays the first, so that
/// displacements count from the same start.
Frames smoothed(const Frames& frames, std::size_t window = 6);

/// (l - L)/L over springs with L > 0, signed: compression is no error of cloth.
struct StretchErrors
{
    double largest = 0;   ///< C_max
    double rms = 0;       ///< C_rms, of all, both signs
    double rms_tension = 0; ///< of max(0, .)
    double percentile_99 = 0; ///< C_99: 99 % of the springs are below
};
StretchErrors stretch_errors(const PhysicalModel& model, Positions x);

/// r_force: largest |M^-1 (force)| / g over moving vertices at rest; r_acc of a static state. Empty without
/// gravity.
std::optional<double> acceleration_residual(const PhysicalModel& model, Positions x);

/// (G(x) - G*) / (G(x_0) - G*). Empty when the start is as low as the minimum.
std::optional<double> energy_gap(double energy, double start, double minimum);

/// Of a series of energies [J] at equal times.
struct EnergyDrift
{
    double per_period = 0; ///< least-squares slope times the period, over E_ref
    double largest = 0;    ///< max |E - E(0)| / E_ref
};
/// `period` in frames; E_ref [J], > 0: the initial energy above the static minimum.
EnergyDrift energy_drift(std::span<const double> energy, double period, double reference_energy);

/// |P - P_0 - impulse| / (M v_ref), v_ref = max(|v_cm|, sqrt(g D)), of the moving vertices.
double momentum_error(const ErrorWeights& weights, Positions velocity, Positions start_velocity,
                      const glm::dvec3& impulse, double gravity);

/// Of a sampled oscillation about zero.
struct Oscillation
{
    double frequency = 0; ///< 1/s, from interpolated zero crossings
    double damping = 0;   ///< zeta = ln(A_n / A_n+1) / (2 pi), mean over the series
    std::size_t periods = 0; ///< whole ones found; 0 = nothing measured
};
Oscillation oscillation(std::span<const double> signal, double timestep);

/// Deepest moving vertex below colliders at `time`, over D; its gap counts as the surface. >= 0.
double penetration(const PhysicalModel& model, const ErrorWeights& weights, Positions x, double time);

} // namespace taut
