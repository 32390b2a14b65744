#pragma once
// How far and how fast what a scene or its program moves has gone, for bounds on the energy that it can have
// put in.

#include "taut/scene/scene.hpp"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// How far and how fast something that moves by itself has gone by a time, and where it was.
struct MoverReach
{
    double time = 0;                           ///< s: end of the stretch
    double speed = 0;                          ///< m/s, largest so far
    double change = 0;                         ///< m/s, of all changes of its velocity so far
    double travel = 0;                         ///< m, longest way so far
    glm::dvec3 low{HUGE_VAL}, high{-HUGE_VAL}; ///< m, box of all places so far
};

/// The same with what goes on from it: per point that is followed its velocity before [m/s], and by how much
/// that has changed in all [m/s]. Bitwise equal tracks go on bitwise equally.
struct MoverTrack
{
    MoverReach reach;
    std::vector<glm::dvec3> velocity;
    std::vector<double> change;
};

/// Corners of the box of some places; a rigid motion moves none of the places faster than the fastest corner.
std::vector<glm::dvec3> box_corners(const glm::dvec3& low, const glm::dvec3& high);

/// Of a box that holds a collider at rest; of a plane, of the part within `diameter` [m] of its point.
std::vector<glm::dvec3> collider_corners(const Collider& collider, double diameter);

/// How many straight lines stand for the motion between two times: one, and one more each quarter of a radian
/// of its fastest turn (a chord this wide is 0.3 % shorter than its arc).
int chords(const std::vector<Keyframe>& motion, double from, double to);

/// Follows `points` (at rest, m) of a motion from one time to another [s], in so many straight lines.
void follow(MoverTrack& track, const std::vector<Keyframe>& motion, std::span<const glm::dvec3> points,
            double from, double to, int lines);

/// Follows points that go straight from `before` to `now` [m] within `seconds`; `rest`: where they began.
void follow(MoverTrack& track, std::span<const glm::dvec3> before, std::span<const glm::dvec3> now,
            std::span<const glm::dvec3> rest, double seconds);

} // namespace taut
