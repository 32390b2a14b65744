#pragma once
// Internal to src/plan: springs and hinges as forces, stepped explicitly. docs/methods/mass_spring.md.

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// What the effects that form forces share while a plan is made.
struct ForceBuffers
{
    std::uint32_t force = kNoBuffer; ///< rvec4 per vertex, N
    std::uint32_t springs = 0;       ///< that can act
    bool damped = false; ///< any spring has a damper
    bool node_centric = true;
    std::uint32_t start = kNoBuffer,
                  ends = kNoBuffer; ///< node-centric: layout::Spring<real>, a = this vertex
    std::uint32_t records = kNoBuffer, incident = kNoBuffer, slots = kNoBuffer; ///< spring-centric

    /// Elements of one kind that write a slot a corner (kernels/methods/mass_spring/mass_spring.comp).
    struct Kind
    {
        std::string effect, kernel;
        std::uint32_t records = kNoBuffer, corners = 2, count = 0, first = 0; ///< first: slot
    };
    std::vector<Kind> kinds;
    std::vector<std::uint32_t> slot_vertex; ///< plan vertex, by slot
    std::uint32_t corner_start = kNoBuffer, corner_incident = kNoBuffer, corner_slots = kNoBuffer;
};

/// The forces of the plan that is made.
ForceBuffers& forces(PlanBuilder& builder);
/// Makes their buffer on account of `effect`, unless it is there.
void add_force_buffer(PlanBuilder& builder, std::string_view effect);
/// Elements that an invocation of one vertex visits, on average, for the accounts.
std::uint32_t per_vertex(const PlanBuilder& builder, std::uint64_t ends);
/// Whether passes of this moment count what reports ask for.
bool report_now(const PlanBuilder& builder, const Moment& moment);

/// For a method that forms the forces of its springs itself: makes the buffer.
void add_inner_forces(PlanBuilder& builder, std::string_view effect, std::uint32_t springs);

/// As refuse_rigid.
void check_mass_spring(const Scene& resolved, Refusals& out);

/// Whether the integrator needs forces also after the guess (velocity Verlet), or kicks then (explicit
/// Euler).
bool wants_forces_after(const Scene& scene);
bool wants_kick(const Scene& scene);
bool wants_kick_after(const Scene& scene);
/// Plan::velocity_lead: before the step, but for the integrators that kick after the displacement.
double velocity_lead(const Scene& scene);

void prepare_spring_force(PlanBuilder& builder);
void prepare_force_kick(PlanBuilder& builder);
void record_spring_force(PlanBuilder& builder, const Moment& moment);
void record_force_kick(PlanBuilder& builder, const Moment& moment);
/// The same after the guess.
void record_spring_force_after(PlanBuilder& builder, const Moment& moment);
void record_force_kick_after(PlanBuilder& builder, const Moment& moment);

} // namespace taut
