#pragma once
// Internal to src/world: what a World owns. Shared by world.cpp and world_state.cpp.

#include "taut/world/at_step.hpp"
#include "taut/world/inputs.hpp"
#include "taut/world/moved.hpp"
#include "taut/world/tearing.hpp"
#include "taut/world/world.hpp"

#include <memory>
#include <vector>

namespace taut {

/// What lists of surfaces that meet hold, as bytes; empty without contact.
struct ContactLists
{
    std::vector<std::byte> control, lost, pair, side, taken, corner_start, corner;
    std::vector<HeldPair> held;
};

/// Places that wait for the next step, as position and low have them, in the plan's order.
struct Placed
{
    std::vector<std::byte> position, low;
    std::vector<bool> waits; ///< by vertex
    bool any = false;
};

/// Vertices of a plan that follow each other.
struct Vertices
{
    std::uint32_t first = 0, count = 0;
};

struct World::Impl
{
    Scene scene;
    Plan plan;
    std::shared_ptr<Device> device;
    std::vector<BufferPtr> buffers;       ///< as plan.buffers
    std::unique_ptr<Recording> recording; ///< null when nothing is to be done
    std::uint64_t steps = 0;
    bool guessed = false; ///< the buffer of predictions is of the last substep: no restore() since
    Clock clock;
    Moved program;
    Placed placed;
    bool moves = false;                 ///< inputs change from step to step
    bool stale = true;                  ///< inputs have changed since they were last written
    std::vector<std::byte> forces;      ///< set from outside, as plan.force; empty without that effect
    std::vector<std::uint32_t> place;   ///< in the plan's order, of each vertex of the scene; for forces
    bool forces_changed = false;        ///< since they were last handed over
    double force_sum = 0;               ///< N, of their lengths
    std::uint32_t contacts_missing = 0; ///< of TAUT_CONTACT_MISSING, when the host looked last
    std::uint64_t refined = 0;          ///< steps that were done again in parts
    std::uint64_t untangled = 0;        ///< steps after which something was taken apart
    bool pinched_last = false;          ///< something, in the last step
    std::uint32_t parts = 1;            ///< of the last step
    GivenUp given_up;
    double push = 0;                    ///< N s, as WorldDrive::push
    double kick = 0;                    ///< sqrt(J), as WorldDrive::kick
    std::uint64_t placings = 0;
    PlanOptions options;
    DeviceTraits traits;
    std::uint64_t torn = 0;     ///< vertices that came apart
    std::uint32_t overlong = 0; ///< what plan.torn counted when it was last looked at

    double time() const { return clock.at(steps); }
    void restart_clock(const Clock& before);
    Pace pace() const;
    Pace pace(const Clock& clock) const;
    std::vector<glm::dvec3> velocities(const Vertices& of) const;
    void move_velocities(const Pace& before);
    void create_buffers();
    void record();
    std::vector<InputWrite> take_inputs();
    void keep_forces(std::vector<std::byte> bytes);
    void weigh_forces();
    void put_force(std::size_t vertex, const glm::dvec3& force);
    void count_step();
    void after_step();
    void replace_scene(const TornScene& next);
    ContactLists contact_lists() const;
    /// `from`: of each vertex the one that it was in `before`.
    void carry_contacts(const ContactLists& before, const std::vector<std::uint32_t>& from,
                        bool same_vertices);
    std::vector<HeldPair> held_pairs() const;
    void put_held_pairs(std::vector<HeldPair> held);
    void grow_contacts();
    void hold_contacts(std::uint32_t capacity);
    std::vector<InputWrite> before_step() const;
    void repeat_step(const std::vector<InputWrite>& before, const std::vector<InputWrite>& inputs);
    void write_now(const std::vector<InputWrite>& writes);
    bool lengthen_lists(std::uint32_t missed_before);
    std::vector<std::uint32_t> lost_words() const;
    std::uint64_t pinches(const std::vector<std::uint32_t>& lost) const;
    bool refine_step(const std::vector<InputWrite>& before, const std::vector<InputWrite>& inputs);
    void untangle();
    void step_in_parts(std::uint32_t count, const std::vector<InputWrite>& inputs);
    void take_timestep(double seconds);
    void do_again(const Stretch& stretch, const ProgramMotion& motion);
    Vertices all() const { return {0, plan.vertex_count}; }
    Vertices of_body(std::size_t body, const char* who) const;
    void put_at(const Vertices& where, std::span<const glm::dvec3> x, const char* who);
    template <typename Real>
    void put_places(const Vertices& where, std::span<const glm::dvec3> x);
    std::vector<InputWrite> take_places();
    /// Of a scene with contact: vertices have jumped, of which its lists know nothing; a search comes next.
    InputWrite lists_forgotten() const;
    void hand_over_places();
    void set_velocities(const Vertices& where, std::span<const glm::dvec3> v, const char* who);
    template <typename Real>
    void replace(std::uint32_t buffer, const Vertices& of, const std::vector<glm::dvec3>& values);
    template <typename Real>
    void speed_up(const Vertices& where, std::span<const glm::dvec3> v);
    /// Of some vertices, in the order of the scene.
    template <typename Real>
    std::vector<glm::dvec3> read_vectors(std::uint32_t buffer, std::uint32_t added, const Vertices& of) const;
    /// The same in the plan's order.
    template <typename Real>
    std::vector<Kept> kept(const Vertices& of) const;
    template <typename Real>
    struct KeptBuffers /// of Kept, as a device has them
    {
        std::vector<glm::vec<4, Real>> velocity, displacement, coasting;
    };
    template <typename Real>
    KeptBuffers<Real> read_kept(const Vertices& of) const;
    template <typename Real>
    std::vector<glm::dvec3> velocities_of(const Vertices& of) const;
    template <typename Real>
    void repace(const Pace& before);
    std::vector<glm::dvec3> vectors(std::uint32_t buffer, std::uint32_t added, const Vertices& of) const;
    std::vector<glm::dvec3> vectors(std::uint32_t buffer) const { return vectors(buffer, kNoBuffer, all()); }
    std::vector<glm::dvec3> positions(const Vertices& of);
    /// One number a constraint of a kind, in the plan's order; empty without such a buffer.
    std::vector<double> of_constraints(std::string_view kind, std::uint32_t ConstraintSet::*buffer) const;
    std::vector<std::byte> raw(std::uint32_t buffer) const;
};

} // namespace taut
