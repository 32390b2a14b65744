#pragma once
// A world whose bodies stop costing anything while they rest.

#include "taut/world/world.hpp"

namespace taut {

struct SleepOptions
{
    WorldOptions world;
    /// A body is quiet below this share of sqrt(g D), its own size D and gravity g (9.81 m/s^2 without any).
    double quiet_speed = 1e-3;
    std::uint64_t look_every = 15; ///< steps between two looks at speeds, >= 1
    std::uint32_t quiet_looks = 2; ///< in a row, before a body falls asleep
};

/// Steps a scene without the bodies that rest. Where bodies meet, those that may touch, by their boxes with a
/// twentieth of their size more, form islands, which sleep and wake as one. A mesh that is led joins nothing
/// while it stands still, and sleeps when all others do. The others move bit for bit as they would beside
/// those that sleep (where bodies meet: if the greatest contact
/// radius is awake, too, and what sleeps would not have called for a search); one that wakes goes
/// on, bit for bit, from the state in which it fell asleep. It wakes before a pin of its own moves, before a
/// moving collider or a body that is awake can reach it (by twice its speeds), and when a force, places or
/// velocities are set on it: also where the program moves the pin, the collider or the mesh. Bodies that the
/// wind can move do not sleep.
///
/// Based on: Erin Catto. Box2D, islands and sleeping (the rule by speed and time).
/// Departures: islands follow from boxes, not from contacts; what sleeps has no plan, so it costs neither
///   dispatches nor memory on the device. Falling asleep and waking make a new plan.
class SleepWorld : public ProgramMoves
{
public:
    /// Throws as World does, and Error{unsupported} under methods that keep more than places and speeds
    /// (Plan::kept), for cloth that can tear, and with SceneContact::guarantee.
    SleepWorld(const Scene& scene, std::shared_ptr<Device> device, const SleepOptions& = {});
    ~SleepWorld();
    SleepWorld(SleepWorld&&) noexcept;
    SleepWorld& operator=(SleepWorld&&) noexcept;

    void step();

    std::uint64_t steps() const;
    double time() const;                        ///< s
    const Scene& scene() const;                 ///< resolved, whole
    std::vector<glm::dvec3> positions() const;  ///< m, in the order of the scene
    std::vector<glm::dvec3> velocities() const; ///< m/s; 0 where asleep
    Events events() const;
    /// What they count, over the whole run; pairs, candidates and capacity of those that are awake.
    ContactCounts contacts() const;
    /// Of those that are awake, with bodies as the scene has them.
    std::vector<BodyContactForce> contact_forces() const;
    std::size_t asleep() const;         ///< bodies that sleep now
    bool asleep(std::size_t body) const;
    const World& awake() const;         ///< the bodies that do not: its plan is all that a step costs
    std::uint64_t changes() const;      ///< how often a plan was made anew

    /// As World::set_force; wakes the body.
    void set_force(std::uint32_t vertex, const glm::dvec3& force);

    /// As those of World, of one body; both wake it. A refused one may have done so, too.
    void set_positions(std::size_t body, std::span<const glm::dvec3> positions);
    void set_velocities(std::size_t body, std::span<const glm::dvec3> velocities);

    /// Gives `whole`, a world of the same scene, the state of this one (for reports and pictures).
    void copy_into(World& whole) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace taut
