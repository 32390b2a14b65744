#pragma once
// What a program has moved, as values: part of WorldState. `from` is where something is, `to` where it is to
// be at the end of the next step; between steps without new orders they are equal.

#include "taut/scene/scene.hpp"
#include "taut/world/mover.hpp"

#include <optional>
#include <vector>

namespace taut {

/// A collider that the program has moved. Times of the keys are not read.
struct ColliderMove
{
    std::uint32_t collider = 0;
    Keyframe from, to;
    bool goes_on = false;   ///< with the velocities below, until it is told otherwise; `to` follows from them
    glm::dvec3 velocity{0}; ///< m/s, of its middle
    glm::dvec3 turn{0};     ///< rad/s, axis times rate
    MoverTrack track;
};

/// A pin with Pin::moved_by_program; places in the order of Pin::vertices, m.
struct PinMove
{
    std::uint32_t body = 0, pin = 0;
    std::vector<glm::dvec3> rest, from, to; ///< rest: at the start
    MoverTrack track;
};

struct WindMove
{
    glm::dvec3 from{0}, to{0}; ///< m/s
    double fastest = 0;        ///< m/s, so far
};

struct ProgramMotion
{
    std::vector<ColliderMove> colliders; ///< ascending
    std::vector<PinMove> pins;           ///< all of a scene, in its order
    std::optional<WindMove> wind;        ///< none: the scene's own
};

} // namespace taut
