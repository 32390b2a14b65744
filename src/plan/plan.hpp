#pragma once
// A scene compiled for a device: passes, sizes, colours, barriers. Immutable values; touches no
// device, can be printed, counted and compared.

#include "taut/runtime/base/dispatch.hpp"
#include "taut/runtime/device.hpp"
#include "taut/scene/scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace taut {

/// A buffer for each ColliderKind.
using ColliderBuffers = std::array<std::uint32_t, kColliderKinds>;
inline constexpr ColliderBuffers kNoColliders = [] {
    ColliderBuffers none{};
    none.fill(kNoBuffer);
    return none;
}();

/// What a plan needs to know of a device. world fills it from a Device; tests write it by hand.
struct DeviceTraits
{
    std::uint64_t max_buffer_bytes = std::uint64_t(1) << 27;
    bool float64 = true;
    std::string executor = "cpu"; ///< as DeviceInfo::executor
    bool hardware_gpu = false;
    /// Further limits, as of the native CPU; max_buffer_bytes and float64 above stand instead of these.
    DeviceLimits limits = {std::uint64_t(1) << 27, 4, 0xffffffffu, 1024, 1u << 20, 256, 8, true};
    // Four measured costs, ns (docs/runtime.md says how).
    double dispatch_ns = 2000;     ///< one more dispatch with its barrier
    double group_barrier_ns = 500; ///< one barrier inside a group of 64
    double element_ns = 1;         ///< one distance constraint, the whole device working
    double lane_element_ns = 10;   ///< the same, one group working alone, per constraint
};

struct PlanOptions
{
    bool residuals = false; ///< keep multipliers, so that residuals can be reported
    /// Names of the effects that exist for this plan; empty: all of the table. For tests (G08).
    std::vector<std::string> available_effects;
    /// Pairs that lists of contact hold; 0: as many as the plan thinks fit. At most 2^21.
    std::uint32_t contact_capacity = 0;
    enum class SmallBodies
    {
        automatic,
        never,
        always
    } small_bodies = SmallBodies::automatic;
};

struct PlanBuffer
{
    std::string name;
    std::string effect; ///< who asked for it
    std::uint64_t bytes = 0;
    std::vector<std::byte> initial; ///< empty = zero
    bool host_written = false;      ///< new contents before every step
};

/// What the passes of one kernel cost in one time step; those of one effect.
struct KernelCost
{
    std::string name; ///< "distance", "distance:lambda"
    std::uint64_t dispatches_per_step = 0;
    std::uint64_t bytes_per_step = 0; ///< as EffectCost::bytes_per_step
};

/// What one effect costs in one time step.
struct EffectCost
{
    std::string name;
    std::vector<KernelCost> kernels; ///< in order of their first pass
    std::uint64_t dispatches_per_step = 0;
    std::uint64_t bytes_allocated = 0;
    std::uint64_t bytes_per_step = 0; ///< bytes of bindings touched, an upper bound of the traffic

    std::vector<std::string> kernel_names() const;
};

/// Where the constraints of one kind went.
struct ConstraintSet
{
    std::string kind;                      ///< "distance", "bending"
    std::uint32_t buffer = kNoBuffer;      ///< records, in colour order
    std::uint32_t multipliers = kNoBuffer; ///< same order; kNoBuffer when none are kept
    std::uint32_t damping = kNoBuffer; ///< s, damper over stiffness, same order; kNoBuffer without dampers
    std::uint32_t count = 0;
    std::vector<std::uint32_t> colour_start; ///< colours + 1
    std::uint32_t table = kNoBuffer;         ///< colours on the device, for groups that run several of them
    /// After the colours, one range each: a hub with constraints that share no other vertex.
    std::vector<std::uint32_t> hub_start; ///< hubs + 1; empty without hubs
    /// After the hubs, small bodies of one group each: their number, first range in the table, constraints.
    std::uint32_t small_bodies = 0, small_range = 0, small_constraints = 0;
    std::uint32_t small_colours = 0; ///< most colours of one small body
    std::uint32_t colour_count() const
    {
        return colour_start.empty() ? 0 : static_cast<std::uint32_t>(colour_start.size() - 1);
    }
};

/// A linear system that is solved on the device in every substep. The buffers hold what
/// linear/cg.hpp says of them.
struct PlanSolver
{
    std::string effect;
    std::uint32_t state = kNoBuffer; ///< where the last solve of the step stands: layout::CgState<real>
    std::uint32_t log = kNoBuffer;   ///< counts over the whole run: layout::SolveLog
};

/// Springs that are constraints as long as they need be (acad).
struct PlanActive
{
    std::uint32_t buffer = kNoBuffer; ///< where their number in the last substep stands, a uint32
    std::uint64_t offset = 0;         ///< bytes
    std::uint32_t candidates = 0;     ///< springs that may be
};

/// What can be asked of surfaces that meet (kernels/shared/contact_rows.h).
struct PlanContact
{
    std::uint32_t control = kNoBuffer; ///< TAUT_CONTACT_WORDS uint32
    std::uint32_t lost = kNoBuffer;    ///< counters of what was left out
    std::uint32_t pair = kNoBuffer;    ///< layout::ContactPair
    std::uint32_t side = kNoBuffer;    ///< layout::ContactSide<real>, a pair
    std::uint32_t taken = kNoBuffer;   ///< multipliers of the last substep, as contact_push leaves them
    std::uint32_t place = kNoBuffer;   ///< rvec4, two a vertex: place and displacement at the last search
    std::uint32_t triangles = 0, capacity = 0;
    bool guarded = false; ///< the guarantee's counters stand behind those of `lost`
    std::uint32_t corner_start = kNoBuffer; ///< uint32: of each vertex among `corner`, and the end
    std::uint32_t corner = kNoBuffer;       ///< uint32: 4 pair + corner
};

/// A pinned vertex that moves.
struct MovingPin
{
    std::uint32_t vertex = 0; ///< in the plan's order
    std::uint32_t body = 0, pin = 0;
    glm::dvec3 rest{0};
    std::uint32_t own = 0; ///< its place in Pin::vertices
};

/// What a vertex' half kick at a step is taken from (src/world/at_step.hpp).
enum class Pull : std::uint8_t
{
    held,    ///< it moves only as it is led
    gravity, ///< of a body on which nothing else acts from outside
    shown,   ///< by what the last substep showed: contacts, pins, air and others may bear it
};

/// Something a user should know before anything runs. The words are those of docs/statuses.md.
struct PlanWarning
{
    std::string word;        ///< "conflict", "degenerate", "energy_growth", "few_substeps" or "precision"
    std::uint64_t count = 1; ///< how many constraints or hinges it is about
    std::string text;        ///< with the numbers

    std::string sentence() const { return word + ": " + text; }
};

struct Plan
{
    Precision precision = Precision::float32;
    double timestep = 0;
    std::uint32_t substeps = 1, iterations = 1;
    double largest_substep = 0; ///< s, beyond which the method is not stable; 0 = none
    /// How far after the step the velocities that are kept stand, in substeps (docs/decisions.md 33): -1/2
    /// where a displacement gives them, 1/2 where it takes them as they are, 0 of velocity Verlet.
    double velocity_lead = -0.5;
    std::vector<Pull> pull; ///< of each plan vertex
    double way_out = 0; ///< m, the furthest that a substep brings a vertex out of a collider it starts in

    std::vector<PlanBuffer> buffers;
    std::vector<Dispatch> passes; ///< one whole time step; buffer numbers index `buffers`; label = effect
    std::vector<bool> barrier_before;
    std::vector<EffectCost> effects; ///< only those that the scene calls for, in order of the step

    std::uint32_t vertex_count = 0;
    std::vector<std::uint32_t> original; ///< scene-wide vertex (bodies one after another) of each plan vertex
    std::vector<std::uint32_t> body_start; ///< first scene-wide vertex of each body, and the total
    std::vector<ConstraintSet> constraints;
    std::vector<MovingPin> moving_pins;
    std::vector<PlanWarning> warnings;
    std::vector<PlanSolver> solvers;
    PlanActive active;
    PlanContact contact;

    /// Further buffers that carry something from one step to the next (flags, histories): part of
    /// a world's state.
    std::vector<std::uint32_t> kept;

    // Buffers the world writes and reads, kNoBuffer where the scene does not need them.
    std::uint32_t position = kNoBuffer; ///< rvec4: xyz m, w = inverse mass 1/kg
    std::uint32_t low = kNoBuffer; ///< rvec4: what position lost to rounding; w = gap kept from colliders, m
    std::uint32_t velocity = kNoBuffer;  ///< rvec4: m/s, as velocity_lead says
    std::uint32_t delta = kNoBuffer;     ///< rvec4: displacement of the last substep, m
    std::uint32_t predicted = kNoBuffer; ///< rvec4: inertial guess of `delta`; with residuals, or a method's
    std::uint32_t coasting = kNoBuffer; ///< rvec4: `delta` had gravity alone acted, m; where any Pull::shown
    std::uint32_t owed = kNoBuffer;     ///< rvec4: angular momentum over mass owed to bodies, m^2/s
    std::uint32_t step_values = kNoBuffer; ///< layout::StepValues<real>
    std::uint32_t events = kNoBuffer;      ///< TAUT_EVENT_COUNT uint32
    std::uint32_t pin_targets = kNoBuffer; ///< 2 rvec4 per moving pin: start and end of the step
    std::uint32_t force = kNoBuffer;       ///< rvec4 per vertex: N
    ColliderBuffers colliders = kNoColliders; ///< records as collider_records() gives them
    std::uint32_t wind = kNoBuffer;      ///< layout::WindValues<real>
    /// layout::Spring<real>: forces of springs that flow (plasticity), each once or from either end, plan
    /// order.
    std::uint32_t flowing = kNoBuffer;
    std::uint32_t torn = kNoBuffer;      ///< uint32: springs beyond the length at which cloth tears, added up

    std::uint64_t bytes_allocated() const;
    std::uint64_t barrier_count() const;
    std::map<std::string, std::uint64_t> constraint_counts() const;
    std::map<std::string, std::uint64_t> colour_counts() const;
};

/// Throws Error{bad_timestep} unless the step lies in (0, 1] s and its substeps are at least 1e-15 s, and
/// Error{unstable_timestep} for substeps longer than `largest` (0 = any).
void check_timestep(double timestep, std::uint32_t substeps, double largest = 0);

/// Compiles a resolved scene. Throws Error{bad_timestep, unstable_timestep, bad_input,
/// degenerate_rest, limit, unsupported}.
Plan make_plan(const Scene& resolved, const DeviceTraits& = {}, const PlanOptions& = {});

} // namespace taut
