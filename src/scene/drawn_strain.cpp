// Based on: a straight line is the shortest between two places.
// Departures: of each pin up to kSampled vertices, and between two keys kBetween moments, are looked at.

#include "taut/scene/drawn_strain.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace taut {
namespace {

constexpr std::size_t kSampled = 16;
constexpr int kBetween = 4;

/// s: when two pins may be furthest apart.
std::vector<double> moments_of(const Pin& a, const Pin& b)
{
    std::vector<double> keys;
    for (const Pin* pin : {&a, &b})
        for (const Keyframe& key : pin->motion)
            keys.push_back(key.time);
    std::sort(keys.begin(), keys.end());
    std::vector<double> out;
    for (std::size_t k = 0; k < keys.size(); ++k)
        for (int i = 0; i < kBetween && (i == 0 || k + 1 < keys.size()); ++i)
            out.push_back(k + 1 < keys.size() ? keys[k] + (keys[k + 1] - keys[k]) * i / kBetween : keys[k]);
    return out;
}

/// Some of the places that a pin holds, m.
std::vector<glm::dvec3> places_of(const Body& body, const Pin& pin)
{
    const std::size_t stride = std::max<std::size_t>((pin.vertices.size() + kSampled - 1) / kSampled, 1);
    std::vector<glm::dvec3> out;
    for (std::size_t i = 0; i < pin.vertices.size(); i += stride)
        out.push_back(body.mesh.positions[pin.vertices[i]]);
    return out;
}

double strain_between(const Body& body, const Pin& a, const Pin& b)
{
    double most = 0;
    const std::vector<double> moments = moments_of(a, b);
    for (const glm::dvec3& p : places_of(body, a))
        for (const glm::dvec3& q : places_of(body, b))
            if (const double length = glm::distance(p, q); length > 0)
                for (const double t : moments)
                    most = std::max(most,
                                    glm::distance(pose(a.motion, t, p), pose(b.motion, t, q)) / length - 1);
    return most;
}

} // namespace

double drawn_strain(const Body& body)
{
    double most = 0;
    for (std::size_t a = 0; a < body.pins.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            most = std::max(most, strain_between(body, body.pins[a], body.pins[b]));
    return most;
}

} // namespace taut
