#include "taut/report/mover_paths.hpp"

#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace taut {
namespace {

constexpr int kLines = 7; ///< that stand for the way between two keys, more than chords() asks for

/// A motion, and the corners of what it carries.
struct Mover
{
    std::vector<Keyframe> motion;
    std::vector<glm::dvec3> corners;
    bool holds = false;
    /// Of kinematic bodies: where the corners start, from which their travel counts; else empty: `corners`.
    std::vector<glm::dvec3> start = {};
};

std::vector<glm::dvec3> posed(const std::vector<Keyframe>& motion, double time,
                              std::vector<glm::dvec3> points)
{
    for (glm::dvec3& p : points)
        p = pose(motion, time, p);
    return points;
}

/// The way of a mover from `from` to `to`, s, in straight lines.
void follow(MoverTrack& track, const Mover& mover, double from, double to)
{
    const int lines = kLines + chords(mover.motion, from, to);
    if (mover.start.empty())
        return follow(track, mover.motion, mover.corners, from, to, lines);
    std::vector<glm::dvec3> before = posed(mover.motion, from, mover.corners);
    for (int k = 1; k <= lines; ++k)
    {
        std::vector<glm::dvec3> now = posed(mover.motion, from + (to - from) * k / lines, mover.corners);
        follow(track, before, now, mover.start, (to - from) / lines);
        before = std::move(now);
    }
}

/// It stands still from its last key on.
void stops(MoverPath& path, const MoverTrack& track)
{
    MoverReach rest = path.reach.back();
    rest.time = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < track.change.size(); ++c)
        rest.change = std::max(rest.change, track.change[c] + glm::length(track.velocity[c]));
    path.reach.push_back(rest);
}

std::vector<Mover> led_pins(const Scene& scene)
{
    std::vector<Mover> out;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        for (const Pin& pin : scene.bodies[b].pins)
        {
            Extent held;
            for (const std::uint32_t v : pin.vertices)
                held.take(held_rest_of(scene.bodies[b])[v]);
            if (pin.motion.empty() || !(held.low.x <= held.high.x))
                continue;
            out.push_back({pin.motion, box_corners(held.low, held.high), !scene.bodies[b].kinematic.used});
            if (scene.bodies[b].kinematic.used)
                out.back().start = posed(pin.motion, 0, out.back().corners);
        }
    return out;
}

/// Of a plane, the part that bodies can be at which fill a box of `diameter`, m.
std::vector<Mover> led_colliders(const Scene& scene, double diameter)
{
    std::vector<Mover> out;
    for (const Collider& c : scene.colliders)
        if (!c.motion.empty() && !c.moved_by_program)
            out.push_back({c.motion, collider_corners(c, diameter), false});
    return out;
}

/// Of a body that follows a sequence.
MoverPath path_of(const SequencePlaces& sequence)
{
    MoverPath path{true, {{}}};
    MoverTrack track;
    const std::size_t vertices = sequence.frames.front().size();
    std::vector<glm::dvec3> start(vertices);
    for (std::size_t v = 0; v < vertices; ++v)
        start[v] = place_at(sequence, 0, v);
    std::vector<glm::dvec3> before = start;
    for (std::size_t f = 0; f < sequence.frames.size(); ++f)
        if (const double time = sequence.start + static_cast<double>(f) / sequence.rate,
            seconds = time - path.reach.back().time;
            seconds > 0)
        {
            follow(track, before, sequence.frames[f], start, seconds);
            before = sequence.frames[f];
            path.reach.push_back(track.reach);
        }
    stops(path, track);
    return path;
}

MoverPath path_of(const Mover& mover)
{
    MoverPath path{mover.holds, {{}}};
    MoverTrack track;
    for (const Keyframe& key : mover.motion)
        if (key.time > path.reach.back().time)
        {
            const double from = path.reach.back().time;
            follow(track, mover, from, key.time);
            path.reach.push_back(track.reach);
        }
    stops(path, track);
    return path;
}

} // namespace

std::vector<MoverPath> pin_paths(const Scene& scene)
{
    std::vector<MoverPath> out;
    for (const Body& body : scene.bodies)
        for (const Pin& pin : body.pins)
            if (pin.places)
            {
                out.push_back(path_of(*pin.places));
                out.back().holds = !body.kinematic.used;
            }
    for (const Mover& mover : led_pins(scene))
        out.push_back(path_of(mover));
    return out;
}

ColliderPaths collider_paths(const Scene& resolved, double diameter)
{
    auto out = std::make_shared<std::vector<MoverPath>>();
    for (const Mover& mover : led_colliders(resolved, diameter))
        out->push_back(path_of(mover));
    return out;
}

} // namespace taut
