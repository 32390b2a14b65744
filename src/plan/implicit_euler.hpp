#pragma once
// Internal to src/plan: the method implicit_euler (docs/methods/implicit_euler.md).

#include "taut/plan/builder.hpp"

namespace taut {

/// Throws Error{unsupported} for springs and hinges that are rigid, which have no force.
void check_implicit_euler(const Scene& resolved, const DeviceTraits&);

void prepare_implicit_euler(PlanBuilder& builder);
/// Once a substep, after the inertial guess and the held vertices.
void record_implicit_start(PlanBuilder& builder, const Moment& moment);
/// One Newton step.
void record_implicit_step(PlanBuilder& builder, const Moment& moment);

/// Plan buffers of layout::Spring and layout::SolidTetrahedron once the method is prepared, one record an
/// element; kNoBuffer where there are none.
struct ImplicitRecords
{
    std::uint32_t springs = kNoBuffer, solids = kNoBuffer;
};
ImplicitRecords implicit_records(const PlanBuilder& builder);

} // namespace taut
