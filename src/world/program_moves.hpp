#pragma once
// What a program moves while it runs, for every kind of world: colliders, pins, wind.

#include "taut/scene/scene.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace taut {

class Moved;

/// Orders for the next step: where colliders and pinned vertices are to be at its end, and the wind there. On
/// the way substeps interpolate as between two keyframes, so a motion by the program and the same by
/// keyframes, a key a step, are equal bit for bit. Surfaces get the velocity that follows from the motion:
/// friction drags. Afterwards what was moved stands still until the next order. Of two orders before a step
/// the later holds.
///
/// Nothing here waits for a device: orders go with the next step's submission, and steps in flight or
/// recorded keep their own. Every function throws Error{bad_input}, naming the argument, and changes nothing
/// then, where something is not there, not as long as asked for or not finite, where a keyframe of the scene
/// moves it, and where a step (of the time step at the order) would take its middle more than kFastestMove
/// times the time step away or turn it by more than half a turn: to put something elsewhere at once,
/// restore() a state.
class ProgramMoves
{
public:
    static constexpr double kFastestMove = 1000; ///< m/s, also of wind

    /// The pose of a collider at the end of the next step, relative to its rest pose as in Collider::motion;
    /// Keyframe::time is not read. Turns are taken the short way where `rotate_degrees` jumps by more than
    /// half a turn. Planes only translate.
    void set_collider_pose(std::size_t collider, const Keyframe& pose);
    /// The same for several, none twice; as many poses as colliders.
    void set_collider_poses(std::span<const std::size_t> colliders, std::span<const Keyframe> poses);
    /// From now on, step by step until another order: m/s of its middle, and `turn` about it, rad/s (axis
    /// times rate).
    void set_collider_velocity(std::size_t collider, const glm::dvec3& velocity,
                               const glm::dvec3& turn = glm::dvec3(0));
    /// Where it is to be at the end of the next step; of one that the program has not moved: the rest pose.
    Keyframe collider_pose(std::size_t collider) const;

    /// m, world: of all vertices of pins with Pin::moved_by_program, body by body, pin by pin, in the order
    /// of Pin::vertices. Between two targets a vertex goes straight. Where cloth tears, pins may have more
    /// vertices after a step: pin_targets().size() says how many targets there are.
    void set_pin_targets(std::span<const glm::dvec3> targets);
    /// The same of one pin: `pin` counts within Body::pins.
    void set_pin_targets(std::size_t body, std::size_t pin, std::span<const glm::dvec3> targets);
    /// The vertices of one pin moved and turned together, from where they were at the start.
    void set_pin_pose(std::size_t body, std::size_t pin, const Keyframe& pose);
    /// As they are to be at the end of the next step, in the order of the first function.
    std::vector<glm::dvec3> pin_targets() const;

    /// m/s at the end of the next step, linear from what it is. Error{unsupported} in scenes without the
    /// effect (`wind.density` above 0 and a body with `drag`).
    void set_wind(const glm::dvec3& velocity);

protected:
    ProgramMoves() = default;
    ~ProgramMoves() = default;
    ProgramMoves(ProgramMoves&& other) noexcept : moved_(std::exchange(other.moved_, nullptr)) {}
    ProgramMoves& operator=(ProgramMoves&& other) noexcept
    {
        moved_ = std::exchange(other.moved_, nullptr);
        return *this;
    }

    Moved* moved_ = nullptr; ///< of the world's own, which outlives every call

    friend class Moved;
};

} // namespace taut
