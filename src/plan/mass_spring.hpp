#pragma once
// Internal to src/plan: springs and hinges as forces, stepped explicitly. docs/methods/mass_spring.md.

#include "taut/plan/builder.hpp"

namespace taut {

/// What the effects spring_force, hinge_force and force_kick share while a plan is made.
struct ForceBuffers
{
    std::uint32_t force = kNoBuffer; ///< rvec4 per vertex, N: of springs and hinges
    std::uint32_t springs = 0;       ///< that can act
    std::uint32_t hinges = 0;
    bool damped = false; ///< any spring has a damper
    bool node_centric = true;
    std::uint32_t start = kNoBuffer,
                  ends = kNoBuffer; ///< node-centric: layout::Spring<real>, a = this vertex
    std::uint32_t records = kNoBuffer, incident = kNoBuffer, slots = kNoBuffer; ///< spring-centric
    std::uint32_t hinge_start = kNoBuffer, hinge_incident = kNoBuffer, hinge_records = kNoBuffer;
};

/// For a method that forms the forces of its springs itself: makes the buffer.
void add_inner_forces(PlanBuilder& builder, std::string_view effect, std::uint32_t springs);

/// As refuse_rigid.
void check_mass_spring(const Scene& resolved, const DeviceTraits&);

/// Whether the integrator needs forces also after the guess (velocity Verlet), or kicks then (explicit
/// Euler).
bool wants_forces_after(const Scene& scene);
bool wants_kick(const Scene& scene);
bool wants_kick_after(const Scene& scene);
/// Plan::velocity_lead: before the step, but for the integrators that kick after the displacement.
double velocity_lead(const Scene& scene);

void prepare_spring_force(PlanBuilder& builder);
void prepare_hinge_force(PlanBuilder& builder);
void prepare_force_kick(PlanBuilder& builder);
void record_spring_force(PlanBuilder& builder, const Moment& moment);
void record_hinge_force(PlanBuilder& builder, const Moment& moment);
void record_force_kick(PlanBuilder& builder, const Moment& moment);
/// The same after the guess.
void record_spring_force_after(PlanBuilder& builder, const Moment& moment);
void record_hinge_force_after(PlanBuilder& builder, const Moment& moment);
void record_force_kick_after(PlanBuilder& builder, const Moment& moment);

} // namespace taut
