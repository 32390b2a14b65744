#pragma once
// The running simulation: owns device state, records a plan once and replays it every step.

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/status.hpp"
#include "taut/runtime/device.hpp"
#include "taut/scene/scene.hpp"
#include "taut/world/program_motion.hpp"
#include "taut/world/program_moves.hpp"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

struct VkCommandBuffer_T;

namespace taut {

/// Since which step a world has run with its present timestep and gravity. Both may change on the way.
struct Clock
{
    std::uint64_t step = 0; ///< where this stretch began
    double time = 0;        ///< s, at that step
    double timestep = 0;    ///< s, since then; 0 = that of the scene
    glm::dvec3 gravity{0};  ///< m/s^2, since then
    glm::dvec3 fall{0};     ///< m/s, integral of gravity over time up to `step`
    double fall_length = 0; ///< m/s, integral of its length
    bool steady = true;     ///< gravity has been the scene's all the time
    double substep = 0;     ///< s, since then; 0 = that of the world
    double lead = -0.5;     ///< Plan::velocity_lead of the world whose clock it is

    double at(std::uint64_t now) const { return time + static_cast<double>(now - step) * timestep; }
};

/// What the guarantee goes on from after steps in which something stays pinched however short their parts are
/// (ContactCounts::refined): after the first the next one is not done in parts, after the second the next
/// three, then seven, then fifteen. One in which nothing is pinched, or no longer, ends that, and what then
/// crosses is taken apart (ContactCounts::untangled).
struct GivenUp
{
    std::uint32_t times = 0;       ///< on end
    std::uint64_t until = 0;       ///< step before which none is tried
    bool tangled = false;          ///< something may cross since
    std::uint64_t tried_until = 0; ///< step before which it is not tried again to take it apart
};

/// A pair of surfaces that friction holds: what it has slipped (kernels/contact/contact_gap.comp).
struct HeldPair
{
    std::array<std::uint32_t, 4> vertex = {};
    std::uint32_t kind = 0; ///< TAUT_CONTACT_VERTEX or TAUT_CONTACT_EDGES
    glm::dvec3 slipped{0};  ///< m: less sum weight (x - x_first)
    glm::dvec3 weight{0};   ///< of the second to the fourth
    bool operator==(const HeldPair&) const = default;
};

/// Everything that a continuation needs, as values: bitwise equal states continue bitwise equally (G09).
/// Vertices are in the plan's order; `hi + lo` is the position.
struct WorldState
{
    std::uint64_t step = 0;
    std::vector<std::byte> position, low, velocity, delta, force; ///< raw device contents
    Clock clock = {};
    std::vector<std::vector<std::byte>> kept = {}; ///< of Plan::kept, in its order
    std::vector<std::byte> coasting = {}; ///< of Plan::coasting; nothing follows from it but velocities()
    std::vector<std::byte> owed = {};     ///< of Plan::owed, a vertex; missing: nothing is owed
    std::vector<HeldPair> held = {};      ///< no pair twice
    ProgramMotion moved = {}; ///< orders that wait for the next step among it; empty: nothing was moved
    std::uint32_t contact_capacity = 0; ///< pairs that lists of contact hold; 0: as the world has them
    double push = 0, kick = 0;          ///< as WorldDrive has them
    std::uint64_t placed = 0;           ///< as WorldDrive::placed
    GivenUp given_up = {};
};

/// What kernels counted since the world was made.
struct Events
{
    std::uint64_t non_finite = 0, speed_clamped = 0, degenerate = 0, conflicts = 0;
};

/// What the linear solves of a run came to: methods that solve systems, on the device, in every substep.
struct SolverReport
{
    std::uint64_t solves = 0;     ///< that had something to solve
    std::uint64_t iterations = 0; ///< of all, up to 2^32 - 1 for each system of the plan
    std::uint64_t most = 0;       ///< iterations of the longest
    std::uint64_t limited = 0;    ///< ended at the limit of iterations
    std::uint64_t failed = 0;     ///< ended as stagnated, indefinite_... or non_finite: what was gained stays
    Status last = Status::zero_right_hand_side; ///< how the last one ended
};

/// What a program has moved, since the world was made or by the state that was restored.
struct DrivenMover
{
    bool holds = false; ///< a pin
    MoverReach reach;
};

/// Of surfaces that meet (docs/contact.md): of the last search, and what was left out since the world was
/// made.
struct ContactCounts
{
    bool any = false;             ///< whether any surface may meet another
    std::uint64_t pairs = 0;      ///< vertices and triangles, and edges, that may meet, of the last search
    std::uint64_t candidates = 0; ///< triangles that were compared for them, from either side
    std::uint64_t searches = 0;   ///< substeps that began with a search, over the whole run
    std::uint64_t missing = 0;    ///< pairs that found no place in the list
    std::uint64_t cut = 0;        ///< searches of a triangle that took too many steps and ended early
    std::uint64_t crowded = 0;    ///< vertices with so many pairs that none acted on them
    std::uint64_t capacity = 0;   ///< pairs that the list holds
    // With SceneContact::guarantee "no_crossing", over the whole run, a vertex and substep each:
    bool guarded = false;
    std::uint64_t filtered = 0; ///< ways of vertices that were cut
    /// Where held vertices that move leave vertices and pairs no place; and, where any are led, `cut` and
    /// `crowded`, since what stands still may be run over. What is not held has given way, or stands still
    /// and may be crossed.
    std::uint64_t pinched = 0;
    std::uint64_t held = 0; ///< stood still, because no plane told a pair apart or a list was too short
    /// Steps that World::step() did again in 4, 16 or 64 parts, because something was pinched in them; what
    /// is counted above is of the parts then, and so are displacements() and multipliers(). There are no
    /// predictions() of such a step.
    std::uint64_t refined = 0;
    /// Times that what crossed after a pinch was taken apart between two steps.
    std::uint64_t untangled = 0;
};

/// One pair of the list: a vertex and a triangle, or two edges.
struct SurfacePair
{
    std::array<std::uint32_t, 4> vertex{}; ///< scene-wide: v, a, b, c; or the ends of one and of the other
    bool edges = false;
    double rest_gap = 0;    ///< m: how far apart they are kept
    glm::dvec3 normal{0};   ///< unit, from the second of the pair to the first; 0 before the first sweep
    double push = 0;        ///< N, 0 or more: force on the first along the normal in the last substep
    glm::dvec3 friction{0}; ///< N: force on the first across the normal in the last substep
};

/// What the surfaces of two bodies do to each other in the last substep.
struct BodyContactForce
{
    std::uint32_t a = 0, b = 0; ///< bodies, a < b, or one body that meets itself
    std::uint64_t pairs = 0;    ///< of the list, that push
    double push = 0;            ///< N: sum of SurfacePair::push
    double friction = 0;        ///< N: sum of the lengths of SurfacePair::friction
    glm::dvec3 force{0};        ///< N: on a, of all pairs together; 0 of a body by itself
};

/// What has driven a world from outside since it was made, for accounts of energy. A state that is restored
/// brings back push, kick and placed.
struct WorldDrive
{
    double time = 0;                     ///< s
    double substep = 0;                  ///< s
    double fall = 0;                     ///< m/s, integral of the length of gravity over time
    bool steady_gravity = true;          ///< it has been that of the scene all the time
    double push = 0;                     ///< N s, integral of the lengths of all external forces
    std::vector<DrivenMover> moved = {}; ///< colliders and pins
    double wind = 0;                     ///< m/s, the fastest that the program has set
    double kick = 0;          ///< sqrt(J), of all changes by set_velocities: of each the root of its energy
    std::uint64_t placed = 0; ///< calls of set_positions: nothing is known of the energy that they gave
};

/// Device time of one step, summed by effect.
struct EffectTime
{
    std::string name;
    std::uint64_t dispatches = 0;
    double milliseconds = 0;
};

struct WorldOptions
{
    PlanOptions plan;
    /// What the plan takes the device for; else its limits, and costs as measure_traits() has them.
    std::optional<DeviceTraits> traits = std::nullopt;
};

/// Vertices of a body: so many from `first` on in the order of the scene.
struct BodyRange
{
    std::uint32_t first = 0, count = 0;
};

/// Threads: one world is used by one thread at a time, const functions included; it may go from one to
/// another. Different worlds may be used at once from several threads, on one device or on several (Device
/// orders them), and results stay as they are one after another, bit for bit.
class World : public ProgramMoves
{
public:
    /// Resolves the scene if its bodies have no meshes yet, has it begin as SceneContact::start says
    /// ("separate" moves vertices), plans it for the device, uploads, records. Throws Error{bad_input} where
    /// there is no device or, with "refuse", surfaces that are to meet go through each other, with "separate"
    /// where they cannot be taken apart; and what resolve() and make_plan() throw.
    World(const Scene& scene, std::shared_ptr<Device> device, const WorldOptions& = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    /// Advances by one time step: one submission. Returns without waiting, but for cloth that can tear and
    /// scenes with contact: there it waits for a word that says whether the plan must change, or, with the
    /// guarantee, the step must be done again (ContactCounts::refined).
    void step();
    /// The same with a timestamp around every dispatch; waits. What is done again is not timed.
    std::vector<EffectTime> step_timed();

    std::uint64_t steps() const;
    double time() const;                ///< s
    glm::dvec3 gravity_impulse() const; ///< m/s, integral of gravity over the time so far
    WorldDrive drive() const;
    const Plan& plan() const;
    const Scene& scene() const; ///< resolved
    Device& device() const;

    /// In the order of the scene: bodies one after another, vertices as in their meshes. Waits.
    std::vector<glm::dvec3> positions() const; ///< m, hi + lo
    /// m/s, at the step. WorldState::velocity is what a method goes on from (Plan::velocity_lead).
    std::vector<glm::dvec3> velocities() const;
    /// Of one body, in the order of its mesh; only these are read. Error{bad_input} without such a body.
    std::vector<glm::dvec3> positions(std::size_t body) const;
    std::vector<glm::dvec3> velocities(std::size_t body) const;
    BodyRange body_range(std::size_t body) const;
    std::vector<glm::dvec3> displacements() const; ///< of the last substep, m
    /// Inertial guess of the displacements of the last substep, m; empty unless residuals are kept, and
    /// from restore() until the next step.
    std::vector<glm::dvec3> predictions() const;
    /// Multipliers of a constraint kind in the plan's order, N s^2; empty when none are kept.
    std::vector<double> multipliers(std::string_view kind) const;
    /// Damper over stiffness of a constraint kind in the plan's order, s; empty without dampers.
    std::vector<double> damping_times(std::string_view kind) const;
    Events events() const;
    /// Since the world was made, over all systems of the plan. All zero under methods without one.
    SolverReport solver_report() const;
    /// Share of the springs that were constraints in the last substep, of those that may be; -1 under methods
    /// without that choice. Waits.
    double active_share() const;
    /// Vertices that came apart so far (Material::tear_strain). Each made a new one, at the end of its
    /// body's: plan(), scene(), position_buffer() and the number of positions change with it.
    std::uint64_t torn() const;

    /// All zero in scenes without contact. Waits, as contact_pairs() does. With contact every step() waits
    /// for one word, and takes longer lists where these are more than half full: plan() and
    /// position_buffer() change then.
    ContactCounts contacts() const;
    /// Those that the last search listed, in the order of the list.
    std::vector<SurfacePair> contact_pairs() const;
    /// Summed by bodies that push each other, ascending. Waits, as contact_pairs() does.
    std::vector<BodyContactForce> contact_forces() const;

    WorldState state() const;
    /// Throws Error{bad_input} when the state is of another plan (also of a cloth torn otherwise) or holds a
    /// value that is not finite. With contact the next step begins with a search: the world that the state
    /// is of may have gone on with an older list, which holds the same pairs that act, unless one of them had
    /// been passed through or the guarantee cuts ways.
    void restore(const WorldState& state);

    /// Force on one vertex [N] from now on; needs Scene::external_forces. A value that is not finite
    /// throws Error{bad_input} and changes nothing (G05). Scene-wide vertex index.
    void set_force(std::uint32_t vertex, const glm::dvec3& force);
    /// The same for all vertices at once, in the order of the scene: exactly as many as it has, else
    /// Error{bad_input}. Neither waits for the device: forces go with the next step.
    void set_forces(std::span<const glm::dvec3> forces);

    /// Puts all vertices [m, in the order of the scene], or those of a body [in that of its mesh], elsewhere.
    /// Velocities at the step stay, and so does all else that a method keeps. Held vertices are put there,
    /// too, and held there; vertices of moving pins return to their targets with the next step. Waits for
    /// nothing: they go with the next step, and until then position_buffer() has those of before.
    /// Error{bad_input} where there are not as many as vertices, where one is not finite or further than
    /// kFarthest from the origin; nothing changes then. Energies are not judged from then on
    /// (WorldDrive::placed).
    void set_positions(std::span<const glm::dvec3> positions);
    void set_positions(std::size_t body, std::span<const glm::dvec3> positions);
    static constexpr double kFarthest = 1e12; ///< m

    /// The same for velocities at the step, m/s; those of held vertices are not read. Waits: what a method
    /// keeps stands half a substep beside the step by what the last one showed, which the device has. All of
    /// that of a vertex gets the same change, so what velocities() gave may be given back and changes
    /// nothing.
    void set_velocities(std::span<const glm::dvec3> velocities);
    void set_velocities(std::size_t body, std::span<const glm::dvec3> velocities);

    /// From now on; the plan stays as it is. A state of another timestep may be restored, too: velocities
    /// at the step stay, so a change makes no jump (A12). Waits, as velocities() does: those kept between the
    /// steps are moved. Throws Error{bad_timestep} outside (0, 1] s (A10) and
    /// Error{unstable_timestep} where an explicit method would not be stable.
    void set_timestep(double seconds);
    /// From now on, m/s^2; waits likewise. Throws Error{bad_input} when not finite. Both change nothing when
    /// they throw.
    void set_gravity(const glm::dvec3& gravity);

    /// For engines: the buffer of rvec4 positions in plan order, and the step as commands.
    BufferPtr position_buffer() const;
    /// Vulkan devices only (else Error{unsupported}, also where cloth can tear). Records one step into the
    /// caller's command buffer, with all that it takes from the host (pins, colliders, gravity, timestep):
    /// any number of recorded steps may wait or run, as long as they are submitted to one queue in the order
    /// in which they were recorded, each once. Before the next call of anything else of this world, but of
    /// what goes with the next step (ProgramMoves, forces, set_positions), all of them must be submitted;
    /// what reads or writes vertices waits for them.
    void record_into(VkCommandBuffer_T* commands);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Limits from the device, costs at their defaults. Runs nothing.
DeviceTraits limits_as_traits(const Device& device);

/// Limits from the device; costs measured by four micro-runs, once per device and process.
DeviceTraits measure_traits(Device& device);

} // namespace taut
