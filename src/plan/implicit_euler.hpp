#pragma once
// Internal to src/plan: the method implicit_euler (docs/methods/implicit_euler.md).

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Throws Error{unsupported} for springs and hinges that are rigid, which have no force.
void check_implicit_euler(const Scene& resolved, Refusals& out);

void prepare_implicit_euler(PlanBuilder& builder);
/// Once a substep, after the inertial guess and the held vertices.
void record_implicit_start(PlanBuilder& builder, const Moment& moment);
/// One Newton step.
void record_implicit_step(PlanBuilder& builder, const Moment& moment);

/// How often a Newton step may be halved: what the scene names, else 16 where a body has tetrahedra, whose
/// energy far from rest grows as (det F)^2, so that a step may be thousands of times too long; else 2
/// (docs/decisions.md, 74).
std::uint32_t line_search_of(const Scene& resolved);

/// Plan buffers of layout::Spring and layout::SolidTetrahedron once the method is prepared, one record an
/// element; kNoBuffer where there are none.
struct ImplicitRecords
{
    std::uint32_t springs = kNoBuffer, solids = kNoBuffer;
};
ImplicitRecords implicit_records(const PlanBuilder& builder);

} // namespace taut
