#include "taut/report/drawn.hpp"

#include "taut/plan/material.hpp"
#include "taut/plan/solid.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <span>

namespace taut {
namespace {

/// m: of a thousand vertices of each, evenly taken; 0 excluded.
double least_distance(const Pin& a, const Pin& b, std::span<const glm::dvec3> x)
{
    constexpr std::size_t kMost = 1000;
    double out = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.vertices.size(); i += a.vertices.size() / kMost + 1)
        for (std::size_t j = 0; j < b.vertices.size(); j += b.vertices.size() / kMost + 1)
        {
            const double distance = glm::distance(x[a.vertices[i]], x[b.vertices[j]]);
            out = distance > 0 ? std::min(out, distance) : out;
        }
    return out;
}

bool either_moves(const Pin& a, const Pin& b) { return is_led(a) || is_led(b); }

/// m: over what length a body is drawn where its pins move: to the nearest pin that moves otherwise, or the
/// body itself.
double drawn_length(const Body& body)
{
    const std::vector<glm::dvec3>& x = body.mesh.positions;
    Extent all;
    for (const glm::dvec3& p : x)
        all.take(p);
    double out = all.size();
    for (std::size_t a = 0; a < body.pins.size(); ++a)
        for (std::size_t b = a + 1; b < body.pins.size(); ++b)
            if (either_moves(body.pins[a], body.pins[b]))
                out = std::min(out, least_distance(body.pins[a], body.pins[b], x));
    return out;
}

/// J/m^2: elastic energy of a body drawn evenly, over the square of how far.
double drawn_stiffness(const Body& body)
{
    double stiff = 0; // J at a strain of 1
    for (const StretchElement& e : stretch_elements(body))
        if (e.compliance > 0)
            stiff += 0.5 * e.rest_length * e.rest_length / e.compliance;
    for (const SolidElement& e : solid_elements(body))
        stiff += 0.5 * (2 * e.mu + e.lambda) * e.rest_volume;
    const double length = drawn_length(body);
    return length > 0 ? stiff / (length * length) : 0;
}

/// Nobody knows where a program takes a pin.
bool turns(const Pin& pin)
{
    return pin.moved_by_program || pin.places ||
           std::any_of(pin.motion.begin(), pin.motion.end(),
                       [](const Keyframe& key) { return key.rotate_degrees != 0; });
}

/// Whether nothing but translations of pins draws the body, and it gives back what they put in.
bool followed(const Scene& scene, const Body& body)
{
    return scene.colliders.empty() && body.start_positions.empty() && !(body.material.tear_strain > 0) &&
           std::none_of(body.pins.begin(), body.pins.end(), turns);
}

/// Of forty vertices of each, evenly taken.
std::vector<glm::dvec3> ways_between(const Pin& a, const Pin& b, std::span<const glm::dvec3> x)
{
    constexpr std::size_t kMost = 40;
    std::vector<glm::dvec3> out;
    for (std::size_t i = 0; i < a.vertices.size(); i += a.vertices.size() / kMost + 1)
        for (std::size_t j = 0; j < b.vertices.size(); j += b.vertices.size() / kMost + 1)
            out.push_back(x[b.vertices[j]] - x[a.vertices[i]]);
    return out;
}

} // namespace

DrawnBodies::DrawnBodies(const Scene& scene)
{
    for (const Body& body : scene.bodies)
    {
        if (body.pins.size() + scene.colliders.size() < 2)
            continue; // what nothing else holds goes along
        const double stiffness = drawn_stiffness(body);
        if (!followed(scene, body))
            stiffness_ += stiffness;
        else
            for (std::size_t a = 0; a < body.pins.size(); ++a)
                for (std::size_t b = a + 1; b < body.pins.size(); ++b)
                    if (const Pin &first = body.pins[a], &second = body.pins[b]; either_moves(first, second))
                        pairs_.push_back({first.motion, second.motion,
                                          ways_between(first, second, body.mesh.positions), stiffness});
    }
}

DrawnBodies::Change DrawnBodies::change(const Pair& pair, double time)
{
    const glm::dvec3 moved = pose(pair.b, time, glm::dvec3(0)) - pose(pair.a, time, glm::dvec3(0));
    Change out;
    for (const glm::dvec3& way : pair.between)
    {
        const double more = glm::length(way + moved) - glm::length(way);
        out.apart = std::max(out.apart, more);
        out.together = std::max(out.together, -more);
    }
    return out;
}

DrawnEnergy DrawnBodies::at(double time, double way) const
{
    const double all = stiffness_ * way * way;
    DrawnEnergy out{all, all};
    for (const Pair& pair : pairs_)
    {
        // Between two keys a distance is a convex function of time: it is longest at one of them.
        Change most = change(pair, time);
        const double now = most.apart;
        for (const std::vector<Keyframe>* keys : {&pair.a, &pair.b})
            for (const Keyframe& key : *keys)
                if (key.time < time)
                {
                    const Change then = change(pair, key.time);
                    most.apart = std::max(most.apart, then.apart);
                    most.together = std::max(most.together, then.together);
                }
        const double together = most.together * most.together;
        out.held += pair.stiffness * (most.apart * most.apart + together);
        out.freed += pair.stiffness * (most.apart * most.apart - now * now + together);
    }
    return out;
}

} // namespace taut
