// Bodies against colliders from one look to the next.
//
// Based on: Provot. Collision and self-collision handling in cloth model dedicated to design garments. 1997
//   (motion in straight lines between two moments); Mirtich. Impulse-based dynamic simulation of rigid body
//   systems. 1996, section 2.3 (distance and speed tell when to look again).
// Departures: what counts is that a surface goes through the middle of a collider, not that it touches it.

#include "taut/report/crossing.hpp"

#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taut {
namespace {

/// The fastest that the keys lead anything within `reach` of `point`, m/s.
double led_speed(const std::vector<Keyframe>& motion, const glm::dvec3& point, double reach)
{
    double most = 0;
    for (std::size_t k = 0; k + 1 < motion.size(); ++k)
    {
        const Keyframe &a = motion[k], &b = motion[k + 1];
        const glm::dvec3 turn =
            glm::radians(b.rotate_degrees) * b.rotate_axis - glm::radians(a.rotate_degrees) * a.rotate_axis;
        const auto [from, to] = centres_between(a, b);
        const double arm = glm::length(point - to) + reach;
        const double way =
            glm::length(b.translate - a.translate) + 2 * glm::length(turn) * arm + glm::length(to - from);
        if (b.time > a.time)
            most = std::max(most, way / (b.time - a.time));
    }
    return most;
}

std::string name_of(const std::string& name, const char* list, std::size_t number)
{
    return name.empty() ? std::string(list) + "[" + std::to_string(number) + "]" : name;
}

/// `first`: of its vertices in the scene.
WatchedBody watched(const Body& body, std::string name, std::uint32_t first)
{
    const Mesh& mesh = body.mesh;
    WatchedBody out;
    out.name = std::move(name);
    out.first = first;
    out.count = mesh.positions.size();
    out.gap = body.material.thickness;
    std::vector<ElementCorners> elements;
    for (const auto& t : mesh.triangles)
        if (!body.kinematic.used) // what is led goes through colliders because its scene says so
            elements.push_back({first + t[0], first + t[1], first + t[2]});
    for (const auto& l : mesh.links)
        elements.push_back({first + l[0], first + l[1], first + l[1]});
    for (const auto& e : elements)
        for (std::size_t k = 0; k < 3; ++k)
            out.edge = std::max(
                out.edge, glm::length(mesh.positions[e[k] - first] - mesh.positions[e[(k + 1) % 3] - first]));
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            out.led_speed = std::max(out.led_speed, led_speed(pin.motion, held_rest_of(body)[v], 0));
    out.groups = ElementGroups(elements, mesh.positions, first);
    return out;
}

std::span<const glm::dvec3> velocities_of(const WatchedBody& body, const LookMoment& now)
{
    return now.motion.v.subspan(body.first, body.count);
}

/// Of the body's vertices relative to what has `velocity`, m/s.
double fastest(const WatchedBody& body, const glm::dvec3& velocity, const LookMoment& now)
{
    double square = 0;
    for (const glm::dvec3& v : velocities_of(body, now))
        square = std::max(square, glm::dot(v - velocity, v - velocity)); // of what is not finite nothing
    return std::sqrt(square);
}

/// Half of how wide the collider is to a body that comes as its mean motion says, and the body's gap.
double width_of(const WatchedBody& body, const WatchedCollider& collider, const LookMoment& now)
{
    glm::dvec3 way(0);
    for (const glm::dvec3& v : velocities_of(body, now))
        way += v / static_cast<double>(body.count);
    way -= collider.velocity(now.time, now.substep);
    const double length = glm::length(way);
    const ColliderFrame frame = frame_at(collider.collider, now.time);
    const glm::dvec3 along = length > 0 ? frame.inside(frame.centre + way) / length : glm::dvec3(0);
    return width_across(collider.shape, along) + body.gap;
}

} // namespace

CrossingWatch::CrossingWatch(const Scene& resolved)
    : gravity_(glm::length(resolved.gravity)),
      timestep_(resolved.timestep),
      clear_(std::numeric_limits<double>::infinity())
{
    for (std::size_t c = 0; c < resolved.colliders.size(); ++c)
    {
        const Collider& collider = resolved.colliders[c];
        if (collider.kind == ColliderKind::plane)
            continue;
        const SolidShape shape = solid_shape(collider);
        colliders_.push_back({name_of(collider.name, "colliders", c), collider, shape,
                              led_speed(collider.motion, frame_at(collider, 0).centre, shape.reach)});
    }
    set_scene(resolved);
    for (std::size_t b = 0; b < bodies_.size(); ++b)
    {
        SurfaceRule rule(resolved.bodies[b]);
        for (const WatchedCollider& c : colliders_)
            pairs_.emplace_back().by_triangles = rule.meets(c.collider);
    }
}

void CrossingWatch::set_scene(const Scene& resolved)
{
    bodies_.clear();
    last_time_.reset();
    if (colliders_.empty())
        return;
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        bodies_.push_back(watched(body, name_of(body.name, "bodies", b), first));
        first += static_cast<std::uint32_t>(body.mesh.positions.size());
    }
    bounds_.resize(bodies_.size());
}

double CrossingWatch::Bounds::distance(const glm::dvec3& point) const
{
    return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0)));
}

CrossingWatch::Motion CrossingWatch::motion_of(const WatchedBody& body, const LookMoment& now)
{
    motions_.clear();
    for (const ElementGroup& group : body.groups.groups())
        motions_.push_back(body.groups.motion(group, now.motion));
    Motion out{{motions_.front().low, motions_.front().high}};
    for (const GroupMotion& group : motions_)
    {
        out.bounds.low = glm::min(out.bounds.low, group.low);
        out.bounds.high = glm::max(out.bounds.high, group.high);
        out.speed = std::max(out.speed, group.speed);
        out.finite = out.finite && group.finite;
    }
    return out;
}

void CrossingWatch::note(std::vector<Crossing>& list, bool& noted, const WatchedBody& body,
                         const WatchedCollider& collider, const LookMoment& now, bool through)
{
    if (!noted)
        list.push_back({body.name, collider.name, now.frame, now.time, through});
    noted = true;
}

void CrossingWatch::look(std::uint64_t frame, double time, double substep,
                         std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities)
{
    if (colliders_.empty())
        return;
    const std::span<const glm::dvec3> last = last_time_ ? last_ : std::span<const glm::dvec3>();
    const LookMoment now{frame, time, substep, {positions, velocities, last}, last_time_};
    clear_ = std::numeric_limits<double>::infinity();
    elements_ = 0;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
    {
        const WatchedBody& body = bodies_[b];
        if (body.groups.empty())
            continue;
        const Motion motion = motion_of(body, now);
        for (std::size_t c = 0; c < colliders_.size() && motion.finite; ++c)
            look_at(body, bounds_[b], motion, colliders_[c], pairs_[b * colliders_.size() + c], now);
        bounds_[b] = motion.bounds;
    }
    found_.elements = std::max(found_.elements, elements_);
    last_.assign(positions.begin(), positions.end());
    last_time_ = time;
    first_ = false;
}

void CrossingWatch::look_at(const WatchedBody& body, const Bounds& last, const Motion& motion,
                            const WatchedCollider& collider, Pair& pair, const LookMoment& now)
{
    const Bounds& bounds = motion.bounds;
    const glm::dvec3 centre = frame_at(collider.collider, now.time).centre;
    const double from_centre = bounds.distance(centre);
    double distance = from_centre - collider.shape.reach;
    if (now.last_time)
    {
        // What swept past in between lies within the bounds of both moments, as the collider sees them.
        const glm::dvec3 was = frame_at(collider.collider, *now.last_time).centre;
        const Bounds both{glm::min(bounds.low - centre, last.low - was),
                          glm::max(bounds.high - centre, last.high - was)};
        distance = std::min(distance, both.distance(glm::dvec3(0)) - collider.shape.reach);
    }
    const double speed = collider.collider.motion.empty()
                             ? motion.speed
                             : fastest(body, collider.velocity(now.time, now.substep), now);
    if (distance <= speed * timestep_)
        return look_closely(body, speed, collider, pair, now);
    pair.inside = false;
    const double away = from_centre - glm::length(middle_half(collider.shape));
    clear_ = std::min(clear_, time_over(away, speed + body.led_speed + collider.led_speed, gravity_));
}

void CrossingWatch::look_closely(const WatchedBody& body, double speed, const WatchedCollider& collider,
                                 Pair& pair, const LookMoment& now)
{
    const double width = pair.by_triangles ? std::numeric_limits<double>::infinity()
                                           : kTunnelHole * width_of(body, collider, now);
    const LookBounds bounds{speed, width, timestep_, gravity_,
                            !pair.inside && !first_};
    const LookFound seen = close_.look(body, collider, motions_, now, bounds);
    found_.depth = std::max(found_.depth, seen.depth);
    pair.inside = seen.deep > 0 && (pair.inside || first_);
    const bool through = now.last_time && !pair.inside && close_.went_through(body, collider, motions_, now);
    if (!pair.inside)
        elements_ += seen.deep;
    found_.passed += through;
    if (through || (seen.deep > 0 && !pair.inside))
        note(found_.seen, pair.seen, body, collider, now, through);
    if (seen.fits || speed * now.substep > kTunnelTravel * collider.shape.size)
    {
        ++found_.may_tunnel;
        note(found_.likely, pair.likely, body, collider, now, false);
    }
    clear_ = std::min(clear_, seen.clear);
}

} // namespace taut
