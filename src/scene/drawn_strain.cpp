// Based on: a straight line is the shortest between two places.
// Departures: up to kMostPins pins, and of each up to kSampled vertices, are looked at, and so are moments
//   between two keys: more where a pin turns by more.

#include "taut/scene/drawn_strain.hpp"

#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

namespace taut {
namespace {

constexpr std::size_t kSampled = 16, kMostPins = 64;
constexpr double kMostDrawn = 0.5; ///< more strain asks for no more substeps

/// s: when a pin may be furthest from another.
void add_moments(const Pin& pin, std::set<double>& out)
{
    constexpr double kTurn = std::numbers::pi / 8;
    constexpr double kLeast = 4, kMost = 64;
    const std::vector<Keyframe>& keys = pin.motion;
    for (std::size_t k = 0; k + 1 < keys.size(); ++k)
    {
        const double turn = std::abs(turn_between(keys[k], keys[k + 1])) / kTurn;
        const double steps = std::ceil(std::clamp(turn, kLeast, kMost));
        for (double i = 0; i < steps; ++i)
            out.insert(keys[k].time + (keys[k + 1].time - keys[k].time) * i / steps);
    }
    if (!keys.empty())
        out.insert(keys.back().time);
}

/// Some of the vertices of a pin: m, at rest and where they start.
struct Held
{
    const Pin* pin;
    std::vector<glm::dvec3> rest, start;
};

std::vector<Held> held_by(const Body& body)
{
    std::vector<Held> out;
    const std::vector<glm::dvec3>& start = held_rest_of(body);
    for (std::size_t k = 0; k < body.pins.size(); k += body.pins.size() / kMostPins + 1)
    {
        const Pin& pin = body.pins[k];
        Held held{&pin, {}, {}};
        for (std::size_t i = 0; i < pin.vertices.size(); i += pin.vertices.size() / kSampled + 1)
        {
            held.rest.push_back(body.mesh.positions[pin.vertices[i]]);
            held.start.push_back(start[pin.vertices[i]]);
        }
        out.push_back(std::move(held));
    }
    return out;
}

double strain_between(const Held& a, const Held& b)
{
    std::set<double> moments{0};
    add_moments(*a.pin, moments);
    add_moments(*b.pin, moments);
    double most = 0;
    for (const double t : moments)
    {
        std::vector<glm::dvec3> there;
        for (const glm::dvec3& q : b.start)
            there.push_back(pose(b.pin->motion, t, q));
        for (std::size_t i = 0; i < a.rest.size(); ++i)
        {
            const glm::dvec3 here = pose(a.pin->motion, t, a.start[i]);
            for (std::size_t j = 0; j < there.size(); ++j)
                if (const double length = glm::distance(a.rest[i], b.rest[j]); length > 0)
                    most = std::max(most, glm::distance(here, there[j]) / length - 1);
        }
    }
    return most;
}

} // namespace

double drawn_strain(const Body& body)
{
    const double tears = body.material.tear_strain;
    const double bound = tears > 0 ? std::min(tears, kMostDrawn) : kMostDrawn;
    const std::vector<Held> held = held_by(body);
    double most = 0;
    for (std::size_t a = 0; a < held.size(); ++a)
        for (std::size_t b = 0; b < a && most < bound; ++b)
            if (!held[a].pin->motion.empty() || !held[b].pin->motion.empty() || !body.start_positions.empty())
                most = std::max(most, strain_between(held[a], held[b]));
    return std::min(most, bound);
}

} // namespace taut
