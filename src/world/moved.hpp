#pragma once
// Internal to src/world: keeps what the program moves, checks its orders, and puts them into the scene of a
// step.

#include "taut/world/program_motion.hpp"
#include "taut/world/program_moves.hpp"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace taut {

class Moved
{
public:
    /// That of a world.
    static Moved& of(const ProgramMoves& world) { return *world.moved_; }

    /// Nothing has been moved, but colliders of a scene that another world had are where they were there.
    /// `scene`: resolved; stays where it is in memory.
    void start(Scene& scene);
    const ProgramMotion& values() const { return values_; }
    /// Throws Error{bad_input} where the values are not of this scene. A state without any: as at the start.
    void check(const Scene& scene, const ProgramMotion& values) const;
    /// Takes checked values and puts what they do not move back to rest.
    void assign(Scene& scene, const ProgramMotion& values);
    /// Takes what a world of which this one is a part has kept, before a step.
    void obey(ProgramMotion values) { values_ = std::move(values); }
    bool idle() const { return values_.colliders.empty() && values_.pins.empty() && !values_.wind; }
    /// Cloth came apart: new vertices of pins are where those were that they came from. `origin`: scene-wide
    /// vertex of each.
    void tear(const Scene& before, const Scene& now, std::span<const std::uint32_t> origin);

    void set_poses(std::span<const std::size_t> colliders, std::span<const Keyframe> poses, const char* who);
    void set_velocity(std::size_t collider, const glm::dvec3& velocity, const glm::dvec3& turn);
    Keyframe pose_of(std::size_t collider) const;
    void set_targets(std::span<const glm::dvec3> targets);
    void set_targets(std::size_t body, std::size_t pin, std::span<const glm::dvec3> targets, const char* who);
    void set_pin_pose(std::size_t body, std::size_t pin, const Keyframe& pose);
    std::vector<glm::dvec3> targets() const;
    void set_wind(const glm::dvec3& velocity);

    /// Puts the motions of the step between two times [s] into the scene, whose keys they become; pins stay
    /// in values(). Says whether inputs differ from those of the last call.
    bool begin_step(Scene& scene, double from, double to);
    void end_step(double seconds);

    /// Whether a pin of a body is on its way.
    bool pins_move(std::size_t body) const;

private:
    ColliderMove& move_of(std::size_t collider);
    const ColliderMove* find(std::size_t collider) const;
    PinMove* find_pin(std::size_t body, std::size_t pin);
    void require_collider(std::size_t collider, const char* who) const;
    ColliderMove ordered(std::size_t collider, const Keyframe& pose, const char* who) const;

    ProgramMotion values_;
    const Scene* scene_ = nullptr;
    double diameter_ = 0; ///< m, of all bodies at rest
    bool settled_ = true; ///< the inputs written last say that nothing moves
};

/// The part of `whole` that is of some bodies of a scene, as those of a scene of their own.
ProgramMotion part_of(const ProgramMotion& whole, const std::vector<std::uint32_t>& bodies);

} // namespace taut
