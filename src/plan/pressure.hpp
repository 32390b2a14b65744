#pragma once
// Internal to src/plan: the effect pressure (docs/effects/pressure.md).

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Whether the surface of any body encloses a gas.
bool wants_pressure(const Scene& resolved);

/// Refuses, as `bad_input`, bodies whose surface is open, or looks to different sides, and as
/// `degenerate_rest` those that enclose nothing.
void check_pressure(const Scene& resolved, Refusals& out);

/// A bound on the largest eigenvalue of M^-1 dF/dx of the gas of a body at rest, 1/s^2 (Gershgorin by rows,
/// and the trace of what the volume's change adds). Beyond 4 / h^2 an explicit force cannot follow it.
double pressure_rate(const Body& body);

/// Throws Error{limit} where more triangles meet at a vertex than one invocation may loop over.
void prepare_pressure(PlanBuilder& builder);
void record_pressure(PlanBuilder& builder, const Moment& moment);

} // namespace taut
