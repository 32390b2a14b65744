// The pose of something that moves by keyframes, or on from a pose.
//
// Based on: Rodrigues' formula; Hamilton's product of turns as quaternions (both as in any textbook of
//   kinematics).

#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {

namespace {

struct Pose
{
    glm::dvec3 translate{0}, rotation{0}, centre{0}; // rotation: axis times angle, rad
};

Pose pose_of(const Keyframe& key) { return {key.translate, rotation_of(key), key.rotate_centre}; }

glm::dvec3 posed(const Pose& pose, const glm::dvec3& rest)
{
    const double angle = glm::length(pose.rotation);
    if (!(angle > 0)) // exactly the rest position, so that a key without rotation adds no rounding
        return rest + pose.translate;
    // Rodrigues' formula.
    const glm::dvec3 axis = pose.rotation / angle, arm = rest - pose.centre;
    const glm::dvec3 turned = arm * std::cos(angle) + glm::cross(axis, arm) * std::sin(angle) +
                              axis * (glm::dot(axis, arm) * (1 - std::cos(angle)));
    return pose.centre + turned + pose.translate;
}

glm::dquat quaternion_of(const glm::dvec3& rotation)
{
    const double angle = glm::length(rotation);
    return angle > 0 ? glm::angleAxis(angle, rotation / angle) : glm::dquat(1, 0, 0, 0);
}

void set_rotation(Keyframe& key, const glm::dvec3& rotation)
{
    const double angle = glm::length(rotation);
    key.rotate_degrees = glm::degrees(angle);
    if (angle > 0)
        key.rotate_axis = rotation / angle;
}

} // namespace

glm::dvec3 rotation_of(const Keyframe& key)
{
    const double length = glm::length(key.rotate_axis);
    const glm::dvec3 axis = length > 0 ? key.rotate_axis / length : glm::dvec3(0);
    return axis * glm::radians(key.rotate_degrees);
}

std::pair<glm::dvec3, glm::dvec3> centres_between(const Keyframe& a, const Keyframe& b)
{
    return {a.rotate_degrees != 0 ? a.rotate_centre : b.rotate_centre,
            b.rotate_degrees != 0 ? b.rotate_centre : a.rotate_centre};
}

double turn_between(const Keyframe& a, const Keyframe& b)
{
    return glm::distance(rotation_of(a), rotation_of(b));
}

void take_short_way(Keyframe& from, Keyframe& to)
{
    double least = turn_between(from, to);
    if (least <= glm::pi<double>())
        return;
    Keyframe first = from, second = to;
    for (Keyframe* key : {&first, &second})
        key->rotate_degrees = std::remainder(key->rotate_degrees, 360.0);
    for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b)
        {
            Keyframe one = first, other = second;
            one.rotate_degrees += 360.0 * a;
            other.rotate_degrees += 360.0 * b;
            if (const double turn = turn_between(one, other); turn < least)
            {
                least = turn;
                from = one;
                to = other;
            }
        }
}

Keyframe about(const Keyframe& pose, const glm::dvec3& centre)
{
    Keyframe out = pose;
    if (pose.rotate_degrees != 0)
        out.translate = posed(pose_of(pose), centre) - centre;
    out.rotate_centre = centre;
    return out;
}

Keyframe moved_on(const Keyframe& pose, const glm::dvec3& centre, const glm::dvec3& velocity,
                  const glm::dvec3& turn, double seconds)
{
    Keyframe out = about(pose, centre);
    out.translate += velocity * seconds;
    const glm::dvec3 had = rotation_of(pose), more = turn * seconds;
    if (more == glm::dvec3(0))
        return out;
    if (glm::cross(had, more) == glm::dvec3(0)) // about one axis angles add up
        set_rotation(out, had + more);
    else
    {
        const glm::dquat q = quaternion_of(more) * quaternion_of(had);
        const double sine = glm::length(glm::dvec3(q.x, q.y, q.z));
        const double angle = 2 * std::atan2(sine, q.w);
        set_rotation(out, sine > 0 ? glm::dvec3(q.x, q.y, q.z) * (angle / sine) : glm::dvec3(0));
    }
    return out;
}

glm::dvec3 pose(const std::vector<Keyframe>& motion, double time, const glm::dvec3& rest)
{
    if (motion.empty())
        return rest;
    const auto after = std::upper_bound(motion.begin(), motion.end(), time,
                                        [](double t, const Keyframe& key) { return t < key.time; });
    if (after == motion.begin())
        return posed(pose_of(motion.front()), rest);
    if (after == motion.end())
        return posed(pose_of(motion.back()), rest);
    const Pose a = pose_of(*(after - 1)), b = pose_of(*after);
    const auto [from, to] = centres_between(*(after - 1), *after);
    const double s = (time - (after - 1)->time) / (after->time - (after - 1)->time);
    // Axis times angle is linear: with one axis the angle is, also beyond a full turn; a key without
    // rotation takes the axis of its neighbour.
    return posed({a.translate + s * (b.translate - a.translate), a.rotation + s * (b.rotation - a.rotation),
                  from + s * (to - from)},
                 rest);
}

void apply(const Transform& transform, std::vector<glm::dvec3>& places)
{
    const std::vector<Keyframe> turn = {
        {0, transform.translate, transform.rotate_axis, transform.rotate_degrees, glm::dvec3(0)}};
    for (glm::dvec3& place : places)
        place = pose(turn, 0, place * transform.scale);
}

bool is_led(const Pin& pin) { return pin.moved_by_program || pin.places || !pin.motion.empty(); }

glm::dvec3 held_at(const Pin& pin, double time, std::size_t own, const glm::dvec3& rest)
{
    return pin.places ? place_at(*pin.places, time, pin.vertices[own]) : pose(pin.motion, time, rest);
}

glm::dvec3 place_at(const SequencePlaces& sequence, double time, std::size_t vertex)
{
    const double last = static_cast<double>(sequence.frames.size() - 1);
    const double at = std::clamp((time - sequence.start) * sequence.rate, 0.0, last);
    const double before = std::min(std::floor(at), std::max(last - 1, 0.0)), part = at - before;
    const glm::dvec3& from = sequence.frames[static_cast<std::size_t>(before)][vertex];
    if (part == 0)
        return from;
    const glm::dvec3& to = sequence.frames[static_cast<std::size_t>(before) + 1][vertex];
    return from + part * (to - from);
}

glm::dvec3 wind_at(const Wind& wind, double time)
{
    const auto after = std::upper_bound(wind.keys.begin(), wind.keys.end(), time,
                                        [](double t, const Wind::Key& key) { return t < key.time; });
    if (after == wind.keys.begin())
        return wind.velocity;
    const Wind::Key& a = *(after - 1);
    if (after == wind.keys.end())
        return a.velocity;
    return a.velocity + (after->velocity - a.velocity) * ((time - a.time) / (after->time - a.time));
}

} // namespace taut
