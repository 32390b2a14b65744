#pragma once
// What pose() of scene.hpp is made of, and poses that go on. Internal.

#include "taut/scene/scene.hpp"

#include <utility>

namespace taut {

/// Takes places of a rest shape into world space.
void apply(const Transform& transform, std::vector<glm::dvec3>& places);

/// m, world: where the vertices of a body with a mesh start.
inline const std::vector<glm::dvec3>& start_of(const Body& body)
{
    return body.start_positions.empty() ? body.mesh.positions : body.start_positions;
}

/// m, world: what the motions of its pins move: where the vertices start; of a kinematic body where its mesh
/// has them.
inline const std::vector<glm::dvec3>& held_rest_of(const Body& body)
{
    return body.kinematic.used ? body.mesh.positions : start_of(body);
}

/// Whether a pin can be elsewhere than where it starts.
bool is_led(const Pin& pin);

/// Where the `own`th vertex of a pin is held at `time` [s], by its motion or its sequence: not for what a
/// program moves. `rest`: where it starts, m.
glm::dvec3 held_at(const Pin& pin, double time, std::size_t own, const glm::dvec3& rest);

/// rad: the axis times the angle of a key, which pose() takes to be linear between keys; 0 without an axis.
glm::dvec3 rotation_of(const Keyframe& key);

/// m: the centres of turning at two keys, of what goes on between them: a key without a turn has that of the
/// other.
std::pair<glm::dvec3, glm::dvec3> centres_between(const Keyframe& a, const Keyframe& b);

/// rad: the turn between two keys, as pose() makes it.
double turn_between(const Keyframe& a, const Keyframe& b);

/// Where that is more than half a turn: describes the same two poses so that it is the least, by angles that
/// differ by full turns.
void take_short_way(Keyframe& from, Keyframe& to);

/// The same pose, turned about `centre` [m, at rest].
Keyframe about(const Keyframe& pose, const glm::dvec3& centre);

/// A pose after `seconds`, with a `velocity` [m/s] of where `centre` [m, at rest] is and a `turn` [rad/s,
/// axis times rate] about it.
Keyframe moved_on(const Keyframe& pose, const glm::dvec3& centre, const glm::dvec3& velocity,
                  const glm::dvec3& turn, double seconds);

} // namespace taut
