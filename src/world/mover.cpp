#include "taut/world/mover.hpp"

#include "taut/scene/collider.hpp"
#include "taut/scene/pose.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

constexpr double kSampleTurn = 0.25; ///< rad

/// rad/s: no stretch between two keys turns faster.
double fastest_turn(const std::vector<Keyframe>& motion)
{
    double out = 0;
    for (std::size_t k = 1; k < motion.size(); ++k)
        out = std::max(out, glm::distance(rotation_of(motion[k]), rotation_of(motion[k - 1])) /
                                (motion[k].time - motion[k - 1].time));
    return out;
}

void prepare(MoverTrack& track, std::size_t points)
{
    track.velocity.resize(points, glm::dvec3(0));
    track.change.resize(points, 0.0);
}

/// One point on a straight line.
void take(MoverTrack& track, std::size_t point, const glm::dvec3& before, const glm::dvec3& now,
          const glm::dvec3& rest, const glm::dvec3& velocity)
{
    track.change[point] += glm::distance(velocity, track.velocity[point]);
    track.velocity[point] = velocity;
    MoverReach& reach = track.reach;
    reach.speed = std::max(reach.speed, glm::length(velocity));
    reach.travel = std::max(reach.travel, glm::distance(now, rest));
    reach.low = glm::min(reach.low, glm::min(now, before));
    reach.high = glm::max(reach.high, glm::max(now, before));
}

void take_changes(MoverTrack& track)
{
    for (const double change : track.change)
        track.reach.change = std::max(track.reach.change, change);
}

} // namespace

std::vector<glm::dvec3> box_corners(const glm::dvec3& low, const glm::dvec3& high)
{
    std::vector<glm::dvec3> out;
    for (int k = 0; k < 8; ++k)
        out.emplace_back((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                         (k & 4) != 0 ? high.z : low.z);
    return out;
}

std::vector<glm::dvec3> collider_corners(const Collider& collider, double diameter)
{
    const ColliderSolid solid = solid_of(collider);
    const ColliderFrame rest = rest_frame(collider);
    // A line along y keeps its ends, a box the ball round it.
    const bool line = solid.radius > 0;
    const glm::dvec3 along = line ? glm::abs(rest.y * solid.half.y) : glm::dvec3(0);
    const double size = !solid.bounded ? diameter : line ? solid.radius : glm::length(solid.half);
    return box_corners(rest.centre - along - size, rest.centre + along + size);
}

int chords(const std::vector<Keyframe>& motion, double from, double to)
{
    return 1 + static_cast<int>(std::min(fastest_turn(motion) * (to - from) / kSampleTurn, 1e5));
}

void follow(MoverTrack& track, const std::vector<Keyframe>& motion, std::span<const glm::dvec3> points,
            double from, double to, int lines)
{
    prepare(track, points.size());
    for (std::size_t c = 0; c < points.size(); ++c)
    {
        glm::dvec3 before = pose(motion, from, points[c]);
        for (int k = 1; k <= lines; ++k)
        {
            const glm::dvec3 now = pose(motion, from + (to - from) * k / lines, points[c]);
            take(track, c, before, now, points[c], (now - before) * (lines / (to - from)));
            before = now;
        }
    }
    take_changes(track);
    track.reach.time = to;
}

void follow(MoverTrack& track, std::span<const glm::dvec3> before, std::span<const glm::dvec3> now,
            std::span<const glm::dvec3> rest, double seconds)
{
    prepare(track, now.size());
    for (std::size_t c = 0; c < now.size(); ++c)
        take(track, c, before[c], now[c], rest[c], (now[c] - before[c]) / seconds);
    take_changes(track);
    track.reach.time += seconds;
}

} // namespace taut
