#include "taut/report/drawn.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/solid.hpp"
#include "taut/report/model.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
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

/// m: over what length others draw or squeeze a body that they meet: across a solid; of cloth, which is only
/// drawn, the side of a square as large.
double touched_length(const Body& body)
{
    if (body.mesh.tetrahedra.empty())
    {
        double area = 0;
        const std::vector<glm::dvec3>& x = body.mesh.positions;
        for (const auto& t : body.mesh.triangles)
            area += 0.5 * glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
        return std::sqrt(area);
    }
    Extent all;
    for (const glm::dvec3& p : body.mesh.positions)
        all.take(p);
    const glm::dvec3 size = all.high - all.low;
    return std::min({size.x, size.y, size.z});
}

/// J at a strain of 1: what added elements, of which nothing is known but their energy, have of a body twice
/// as large and of the worst of its shears by 1.
double added_stiffness(const Body& body)
{
    const std::vector<AddedElement> elements = body_elements(body, 0);
    const auto energy_of = [&](const auto& placed) {
        std::vector<glm::dvec3> x;
        x.reserve(body.mesh.positions.size());
        for (const glm::dvec3& p : body.mesh.positions)
            x.push_back(placed(p));
        double sum = 0;
        for (const AddedElement& e : elements)
        {
            const double energy = e.energy(x);
            sum += std::isfinite(energy) ? energy : 0; // it may be without bound so far out
        }
        return sum;
    };
    double worst = 0;
    for (int along = 0; along < 3 && !elements.empty(); ++along)
        for (int across = 0; across < 3; ++across)
            if (along != across)
                worst = std::max(worst, energy_of([&](glm::dvec3 p) {
                                     p[along] += p[across];
                                     return p;
                                 }));
    return elements.empty() ? 0 : worst + energy_of([](const glm::dvec3& p) { return 2.0 * p; });
}

/// J/m^2: elastic energy of a body drawn evenly over `length` [m], over the square of how far.
double drawn_stiffness(const Body& body, double length)
{
    double stiff = added_stiffness(body); // J at a strain of 1
    for (const StretchElement& e : stretch_elements(body))
        if (e.compliance > 0)
            stiff += 0.5 * e.rest_length * e.rest_length / e.compliance;
    for (const SolidElement& e : solid_elements(body))
        stiff += 0.5 * (2 * e.mu + e.lambda) * e.rest_volume;
    return length > 0 ? stiff / (length * length) : 0;
}

/// Nobody knows where a program takes a pin.
bool turns(const Pin& pin)
{
    return pin.moved_by_program || pin.places ||
           std::any_of(pin.motion.begin(), pin.motion.end(),
                       [](const Keyframe& key) { return key.rotate_degrees != 0; });
}

/// Places that are held, and how many of them move, of the bodies of a part.
struct Holders
{
    std::size_t held = 0, move = 0;
};

/// A sequence is a skin, which draws what it wears by its bends: nobody bounds that by its way, and cloth
/// that is worn has nothing else to hold it.
std::vector<Holders> holders_of(const Scene& scene, const std::vector<std::size_t>& part)
{
    std::vector<Holders> out(part.size());
    for (std::size_t b = 0; b < part.size(); ++b)
        for (const Pin& pin : scene.bodies[b].pins)
        {
            out[part[b]].held += 1;
            out[part[b]].move += is_led(pin) && !pin.places;
        }
    return out;
}

/// Whether nothing but translations of pins draws the body, and it gives back what they put in.
bool followed(const Scene& scene, const Body& body)
{
    return scene.colliders.empty() && body.start_positions.empty() && !(body.material.tear_strain > 0) &&
           std::none_of(body.pins.begin(), body.pins.end(), turns);
}

/// J/m^2: of a body with what its own pins and the colliders draw; what nothing else holds goes along.
double pins_stiffness(const Scene& scene, const Body& body)
{
    const bool alone = body.pins.size() + scene.colliders.size() < 2;
    return alone ? 0 : drawn_stiffness(body, drawn_length(body));
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
    const std::vector<std::size_t> part = meeting_parts(scene);
    const std::vector<Holders> holders = holders_of(scene, part);
    const auto led_colliders = static_cast<std::size_t>(
        std::count_if(scene.colliders.begin(), scene.colliders.end(),
                      [](const Collider& c) { return !c.motion.empty() || c.moved_by_program; }));
    for (std::size_t k = 0; k < part.size(); ++k)
    {
        const Body& body = scene.bodies[k];
        const Holders& near = holders[part[k]];
        const std::size_t move = near.move + led_colliders;
        if (move > 0 && near.held > body.pins.size() && near.held + scene.colliders.size() >= 2)
        {
            const double length = std::min(drawn_length(body), touched_length(body));
            // Two that move draw it by both their ways.
            met_stiffness_ += drawn_stiffness(body, length) * (move > 1 ? 4 : 1);
            stiffness_ += pins_stiffness(scene, body);
        }
        else if (!followed(scene, body))
        {
            const double stiffness = pins_stiffness(scene, body);
            met_stiffness_ += stiffness;
            stiffness_ += stiffness;
        }
        else
            follow(body);
    }
}

void DrawnBodies::follow(const Body& body)
{
    if (std::none_of(body.pins.begin(), body.pins.end(), is_led))
        return;
    const double stiffness = drawn_stiffness(body, drawn_length(body));
    for (std::size_t a = 0; a < body.pins.size(); ++a)
        for (std::size_t b = a + 1; b < body.pins.size(); ++b)
            if (const Pin& first = body.pins[a], &second = body.pins[b]; either_moves(first, second))
                pairs_.push_back({first.motion, second.motion,
                                  ways_between(first, second, body.mesh.positions), stiffness});
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

DrawnEnergy DrawnBodies::at(double time, double travel, double depth) const
{
    const double way = travel + depth;
    const double all = (travel > 0 ? met_stiffness_ : stiffness_) * way * way;
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
