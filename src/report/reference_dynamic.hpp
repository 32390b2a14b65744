#pragma once
// Reference R3: the trajectory of a model by small explicit steps in fp64, with its own error estimate.

#include "taut/report/errors.hpp"
#include "taut/report/model.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace taut {

struct DynamicOptions
{
    enum class Scheme
    {
        automatic,        ///< euler with colliders, else verlet
        symplectic_euler, ///< v, then x: first order
        verlet,           ///< half kick, drift, half kick, damping split evenly: second order; no colliders
    };
    Scheme scheme = Scheme::automatic;
    double duration = -1;       ///< s, whole time steps of it; < 0 = the scene's
    double safety = 0.1;        ///< largest step over the stability limit 2/frequency_bound, (0, 0.5]
    std::uint32_t levels = 4;   ///< runs at h, h/2, h/4, ...; >= 4, for two observed orders
    double max_element_steps = 5e9; ///< element_cost() x steps, all levels; a core does
                                    ///< about 1e8 a second
    bool two_threads = true;    ///< the finest level beside the others
};

/// A reference only when `verified`, or for its first `verified_frames` (swinging cloth is chaotic: after a
/// while no step size agrees with the next); else `reason` says why not, with numbers.
struct DynamicReference
{
    bool verified = false;
    std::size_t verified_frames = 0; ///< after the start
    std::string reason;
    Frames frames;                 ///< finest level, at multiples of the scene's time step; empty if refused
    double step = 0;               ///< s, of the finest level
    double order = 0;              ///< the scheme's own
    // The next three are of the verified frames; of all frames if there are none.
    std::vector<double> orders;    ///< observed, log2 of successive differences, coarse to fine
    double error = 0;              ///< estimate of e_traj
    std::vector<double> errors;    ///< the same of the frames up to each; inf where those are not verified
    double largest_error = 0;      ///< estimate of e_L, the largest of all frames; 0 if the scene has no size
    double element_steps = 0;      ///< what it cost or would have cost
};

/// Verified: both last observed orders are within 0.15 of the scheme's and the last difference is below 1 %
/// (or it is rounding), measured over all frames up to there, without a break.
/// Refuses, with a reason: rigid elements, a start inside a collider, and a cost above max_element_steps.
DynamicReference solve_dynamic(const PhysicalModel& model, const DynamicOptions& options = {});

} // namespace taut
