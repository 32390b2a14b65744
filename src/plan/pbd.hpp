#pragma once
// Internal to src/plan: position-based dynamics. docs/methods/pbd.md.

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Throws Error{unsupported} for a damper along springs, and for Chebyshev's acceleration without Jacobi or
/// with too few iterations.
void check_pbd(const Scene& resolved, Refusals& out);

/// Which of the two forms of the method a scene asks for.
bool pbd_is_coloured(const Scene& scene);

/// The share of a correction that one of `iterations` makes, so that all together make `stiffness` of it.
double pbd_share(double stiffness, std::uint32_t iterations);

/// Chebyshev's weight of an iteration (counted from 0); 1 = none. Wang 2015; four plain iterations first.
double chebyshev_weight(double spectral_radius, std::uint32_t iteration);

// Gauss-Seidel by colours: "pbd_stretch", "pbd_bend" and "pbd_volume".
void prepare_pbd_stretch(PlanBuilder& builder);
void prepare_pbd_bend(PlanBuilder& builder);
void prepare_pbd_volume(PlanBuilder& builder);
/// Passes of one sweep over the colours of a set. `kernel`: that of PBD for the set's element; all of them
/// have the interface of kernels::pbd_spring. `stiffness`: of method.stretch and its like, 0 to 1.
void record_pbd_sweep(PlanBuilder& builder, const ConstraintSet& set, std::string_view kernel,
                      std::uint32_t vertices_each, double stiffness, const Moment& moment);
void record_pbd_stretch(PlanBuilder& builder, const Moment& moment);
void record_pbd_bend(PlanBuilder& builder, const Moment& moment);
void record_pbd_volume(PlanBuilder& builder, const Moment& moment);

// Averaged Jacobi over springs, hinges and tetrahedra together, "pbd_jacobi": vertices gather, or constraints
// write slots.
void prepare_pbd_jacobi(PlanBuilder& builder);
void record_pbd_jacobi(PlanBuilder& builder, const Moment& moment);

} // namespace taut
