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

/// Steps a scene without the bodies that rest. Bodies do not touch each other, so the others move bit for bit
/// as they would beside them; one that wakes goes on, bit for bit, from the state in which it fell asleep. It
/// wakes before a pin of its own moves, before a moving collider can reach it, and when a force, places or
/// velocities are set on it: also where the program moves the pin or the collider.
/// Bodies that the wind can move do not sleep.
///
/// Based on: Erin Catto. Box2D, islands and sleeping (the rule by speed and time).
/// Departures: an island is a body; what sleeps has no plan, so it costs neither dispatches nor memory on the
///   device. Falling asleep and waking make a new plan.
class SleepWorld : public ProgramMoves
{
public:
    /// Throws as World does, and Error{unsupported} under methods that keep more than places and speeds
    /// (Plan::kept), and for cloth that can tear.
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
