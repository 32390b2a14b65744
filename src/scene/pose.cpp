// The pose of something that moves by keyframes.

#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>

namespace taut {

namespace {

struct Pose
{
    glm::dvec3 translate{0}, rotation{0}, centre{0}; // rotation: axis times angle, rad
};

Pose pose_of(const Keyframe& key)
{
    return {key.translate, rotation_of(key), key.rotate_centre};
}

glm::dvec3 apply(const Pose& pose, const glm::dvec3& rest)
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

} // namespace

glm::dvec3 rotation_of(const Keyframe& key)
{
    const double length = glm::length(key.rotate_axis);
    const glm::dvec3 axis = length > 0 ? key.rotate_axis / length : glm::dvec3(0);
    return axis * glm::radians(key.rotate_degrees);
}

glm::dvec3 pose(const std::vector<Keyframe>& motion, double time, const glm::dvec3& rest)
{
    if (motion.empty())
        return rest;
    const auto after = std::upper_bound(motion.begin(), motion.end(), time,
                                        [](double t, const Keyframe& key) { return t < key.time; });
    if (after == motion.begin())
        return apply(pose_of(motion.front()), rest);
    if (after == motion.end())
        return apply(pose_of(motion.back()), rest);
    const Pose a = pose_of(*(after - 1)), b = pose_of(*after);
    const double s = (time - (after - 1)->time) / (after->time - (after - 1)->time);
    // Axis times angle is linear: with one axis the angle is, also beyond a full turn; a key without
    // rotation takes the axis of its neighbour.
    return apply({a.translate + s * (b.translate - a.translate), a.rotation + s * (b.rotation - a.rotation),
                  a.centre + s * (b.centre - a.centre)},
                 rest);
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
