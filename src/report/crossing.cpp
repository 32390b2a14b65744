// Bodies against colliders from one look to the next.
//
// Based on: Provot. Collision and self-collision handling in cloth model dedicated to design garments. 1997
//   (motion in straight lines between two moments); Mirtich. Impulse-based dynamic simulation of rigid body
//   systems. 1996, section 2.3 (distance and speed tell when to look again).
// Departures: what counts is that a surface goes through the middle of a collider, not that it touches it.

#include "taut/report/crossing.hpp"
#include "taut/report/is_finite.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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
        const double arm = glm::length(point - b.rotate_centre) + reach;
        const double way = glm::length(b.translate - a.translate) + 2 * glm::length(turn) * arm +
                           glm::length(b.rotate_centre - a.rotate_centre);
        if (b.time > a.time)
            most = std::max(most, way / (b.time - a.time));
    }
    return most;
}

std::string name_of(const std::string& name, const char* list, std::size_t number)
{
    return name.empty() ? std::string(list) + "[" + std::to_string(number) + "]" : name;
}

/// Square of the distance from the box between `low` and `high` to the one between -half and half.
double square_apart(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& half)
{
    const glm::dvec3 gap = glm::max(glm::max(low - half, -half - high), glm::dvec3(0));
    return glm::dot(gap, gap);
}

/// Whether a hole wider than `width` may be there: the smallest ball round a triangle has at most 1 / sqrt(3)
/// of its longest edge.
bool hole_may_pass(const TriangleCorners& t, double width)
{
    const glm::dvec3 a = t[1] - t[0], b = t[2] - t[1], c = t[0] - t[2];
    return std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)}) > 2.999 * width * width;
}

/// The furthest that any point moved.
double furthest(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after)
{
    double square = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        square = std::max(square, glm::dot(after[i] - before[i], after[i] - before[i]));
    return std::sqrt(square);
}

/// How long `distance` lasts at `speed` (doubled) and under `gravity`, s.
double time_over(double distance, double speed, double gravity)
{
    if (!(distance > 0))
        return 0;
    // 2 (speed t + gravity t^2 / 2) = distance
    const double root = std::sqrt(speed * speed + gravity * distance);
    return root + speed > 0 ? distance / (root + speed) : std::numeric_limits<double>::infinity();
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
        obstacles_.push_back({name_of(collider.name, "colliders", c), collider, shape,
                              led_speed(collider.motion, frame_at(collider, 0).centre, shape.reach)});
    }
    set_scene(resolved);
    pairs_.resize(parts_.size() * obstacles_.size());
}

void CrossingWatch::set_scene(const Scene& resolved)
{
    parts_.clear();
    last_time_.reset();
    if (obstacles_.empty())
        return;
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        const Mesh& mesh = body.mesh;
        Part part;
        part.name = name_of(body.name, "bodies", b);
        part.first = first;
        part.count = mesh.positions.size();
        part.gap = body.material.thickness;
        for (const auto& t : mesh.triangles)
            if (!body.kinematic.used) // what is led goes through colliders because its scene says so
                part.elements.push_back({first + t[0], first + t[1], first + t[2]});
        for (const auto& l : mesh.links)
            part.elements.push_back({first + l[0], first + l[1], first + l[1]});
        for (const auto& e : part.elements)
            for (std::size_t k = 0; k < 3; ++k)
                part.edge = std::max(part.edge, glm::length(mesh.positions[e[k] - first] -
                                                            mesh.positions[e[(k + 1) % 3] - first]));
        for (const Pin& pin : body.pins)
            for (const std::uint32_t v : pin.vertices)
                part.led_speed = std::max(part.led_speed, led_speed(pin.motion, mesh.positions[v], 0));
        first += static_cast<std::uint32_t>(part.count);
        parts_.push_back(std::move(part));
    }
}

double CrossingWatch::Bounds::distance(const glm::dvec3& point) const
{
    return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0)));
}

CrossingWatch::Motion CrossingWatch::motion_of(const Part& part, const Moment& now) const
{
    Motion out;
    Bounds& bounds = out.bounds;
    bounds.low = bounds.high = now.x[part.first];
    double speed = 0, way = 0; // squares
    for (std::size_t i = part.first; i < part.first + part.count; ++i)
    {
        const glm::dvec3 &x = now.x[i], &v = now.v[i];
        bounds.low = glm::min(bounds.low, x);
        bounds.high = glm::max(bounds.high, x);
        bounds.finite = bounds.finite && is_finite(x);
        speed = std::max(speed, glm::dot(v, v));
        out.mean += v;
        if (last_time_)
            way = std::max(way, glm::dot(x - last_[i], x - last_[i]));
    }
    out.mean /= static_cast<double>(part.count);
    out.speed = std::sqrt(speed);
    out.way = std::sqrt(way);
    return out;
}

/// How fast each vertex and the collider move towards or past each other; gives the fastest.
double CrossingWatch::speeds_of(const Part& part, const Obstacle& obstacle, const Moment& now)
{
    const double step = now.substep;
    const glm::dvec3 collider =
        (frame_at(obstacle.collider, now.time + step).centre - frame_at(obstacle.collider, now.time).centre) /
        step;
    speeds_.resize(part.count);
    double most = 0;
    for (std::size_t i = 0; i < part.count; ++i)
    {
        speeds_[i] = glm::length(now.v[part.first + i] - collider);
        most = std::max(most, speeds_[i]); // of what is not finite nothing
    }
    return most;
}

/// Half of how wide the collider is to a body that comes as its mean motion says, and the body's gap.
double CrossingWatch::width_of(const Part& part, const Motion& motion, const Obstacle& obstacle,
                               const Moment& now) const
{
    const ColliderFrame frame = frame_at(obstacle.collider, now.time);
    glm::dvec3 way = motion.mean * now.substep;
    way -= frame_at(obstacle.collider, now.time + now.substep).centre - frame.centre;
    const double length = glm::length(way);
    const glm::dvec3 along = length > 0 ? frame.inside(frame.centre + way) / length : glm::dvec3(0);
    return width_across(obstacle.shape, along) + part.gap;
}

void CrossingWatch::note(std::vector<Crossing>& list, bool& noted, const Part& part, const Obstacle& obstacle,
                         const Moment& now, bool through) const
{
    if (!noted)
        list.push_back({part.name, obstacle.name, now.frame, now.time, through});
    noted = true;
}

void CrossingWatch::look(std::uint64_t frame, double time, double substep,
                         std::span<const glm::dvec3> positions, std::span<const glm::dvec3> velocities)
{
    if (obstacles_.empty())
        return;
    const Moment now{frame, time, substep, positions, velocities};
    clear_ = std::numeric_limits<double>::infinity();
    elements_ = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p)
    {
        Part& part = parts_[p];
        if (part.elements.empty())
            continue;
        const Motion motion = motion_of(part, now);
        for (std::size_t o = 0; o < obstacles_.size() && motion.bounds.finite; ++o)
            look_at(part, motion, obstacles_[o], pairs_[p * obstacles_.size() + o], now);
        part.last = motion.bounds;
    }
    found_.elements = std::max(found_.elements, elements_);
    last_.assign(positions.begin(), positions.end());
    last_time_ = time;
    first_ = false;
}

void CrossingWatch::look_at(const Part& part, const Motion& motion, const Obstacle& obstacle, Pair& pair,
                            const Moment& now)
{
    const Bounds& bounds = motion.bounds;
    const glm::dvec3 centre = frame_at(obstacle.collider, now.time).centre;
    double distance = bounds.distance(centre) - obstacle.shape.reach;
    const double away = distance;
    if (last_time_)
    {
        // What swept past in between lies within the bounds of both moments, as the collider sees them.
        const glm::dvec3 was = frame_at(obstacle.collider, *last_time_).centre;
        const Bounds both{glm::min(bounds.low - centre, part.last.low - was),
                          glm::max(bounds.high - centre, part.last.high - was)};
        distance = std::min(distance, both.distance(glm::dvec3(0)) - obstacle.shape.reach);
    }
    const double speed =
        obstacle.collider.motion.empty() ? motion.speed : speeds_of(part, obstacle, now);
    if (distance <= speed * timestep_)
        return look_closely(part, motion, obstacle, pair, now);
    pair.inside = false;
    clear_ = std::min(clear_, time_over(away, speed + part.led_speed + obstacle.led_speed, gravity_));
}

void CrossingWatch::look_closely(const Part& part, const Motion& motion, const Obstacle& obstacle, Pair& pair,
                                 const Moment& now)
{
    const double speed = speeds_of(part, obstacle, now);
    into_frame(part, obstacle, now.x, now.time, after_);
    const Scan seen = scan(part, obstacle, pair, speed, kTunnelHole * width_of(part, motion, obstacle, now));
    pair.inside = seen.deep > 0 && (pair.inside || first_);
    const bool through = last_time_ && !pair.inside && went_through(part, motion, obstacle, seen.nearest);
    if (!pair.inside)
        elements_ += seen.deep;
    found_.passed += through;
    if (through || (seen.deep > 0 && !pair.inside))
        note(found_.seen, pair.seen, part, obstacle, now, through);
    if (seen.fits || speed * now.substep > kTunnelTravel * obstacle.shape.size)
    {
        ++found_.may_tunnel;
        note(found_.likely, pair.likely, part, obstacle, now, false);
    }
    clear_ = std::min(clear_, seen.clear);
}

void CrossingWatch::into_frame(const Part& part, const Obstacle& obstacle, std::span<const glm::dvec3> x,
                               double time, std::vector<glm::dvec3>& out)
{
    const ColliderFrame frame = frame_at(obstacle.collider, time);
    out.resize(part.count);
    for (std::size_t i = 0; i < part.count; ++i)
        out[i] = frame.inside(x[part.first + i]);
}

/// Squares of distances throughout: most elements are far from everything, and need no root.
CrossingWatch::Scan CrossingWatch::scan(const Part& part, const Obstacle& obstacle, const Pair& pair,
                                        double speed, double width)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const SolidShape& shape = obstacle.shape;
    const glm::dvec3 middle = shape.radius > 0 ? shape.half : shape.half - shape.size;
    const double led = part.led_speed + obstacle.led_speed;
    const double reach = shape.radius + speed * timestep_; // of what may arrive within a frame
    // Beyond it of the middle an element is beyond `reach` of the box.
    const double far = reach + glm::length(shape.half - middle);
    Scan out{infinite, infinite};
    for (const auto& e : part.elements)
    {
        const std::size_t k[] = {e[0] - part.first, e[1] - part.first, e[2] - part.first};
        const TriangleCorners at{after_[k[0]], after_[k[1]], after_[k[2]]};
        const glm::dvec3 low = glm::min(glm::min(at[0], at[1]), at[2]);
        const glm::dvec3 high = glm::max(glm::max(at[0], at[1]), at[2]);
        const double apart = square_apart(low, high, middle);
        out.nearest = std::min(out.nearest, apart);
        // Neighbours pull: a quarter of the body's speed at least.
        const double own = std::max({0.25 * speed, speeds_[k[0]], speeds_[k[1]], speeds_[k[2]]}) + led;
        const double way = 2 * (own + 0.5 * gravity_ * out.clear) * out.clear;
        if (apart < way * way || out.clear == infinite)
            out.clear = std::min(out.clear, time_over(std::sqrt(apart), own, gravity_));
        if (apart > far * far)
            continue;
        const double distance = square_apart(low, high, shape.half);
        if (distance > reach * reach)
            continue;
        out.fits = out.fits || (hole_may_pass(at, width) && hole_of(at) > width);
        if (distance > 0.25 * shape.radius * shape.radius || !lies_deep(shape, at, part.edge))
            continue;
        ++out.deep;
        if (!pair.inside && !first_)
            found_.depth = std::max(found_.depth, depth_of(shape, at));
    }
    out.nearest = std::sqrt(out.nearest);
    return out;
}

bool CrossingWatch::went_through(const Part& part, const Motion& motion, const Obstacle& obstacle,
                                 double nearest)
{
    const double size = 0.5 * obstacle.shape.size;
    // A collider that stands sees the ways as they are, so most looks end here.
    if (obstacle.collider.motion.empty() && nearest > motion.way + size)
        return false;
    into_frame(part, obstacle, last_, *last_time_, before_);
    if (nearest > furthest(before_, after_) + size)
        return false;
    const std::vector<glm::dvec3> middle = middle_points(obstacle.shape, part.edge);
    glm::dvec3 low = middle.front(), high = low;
    for (const glm::dvec3& p : middle)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 disc(size); // what links find where the middle is a point
    for (const auto& e : part.elements)
    {
        const bool link = e[1] == e[2];
        TriangleCorners before, after;
        glm::dvec3 least(std::numeric_limits<double>::infinity()), most = -least;
        for (std::size_t k = 0; k < 3; ++k)
        {
            before[k] = before_[e[k] - part.first];
            after[k] = after_[e[k] - part.first];
            least = glm::min(least, glm::min(before[k], after[k]));
            most = glm::max(most, glm::max(before[k], after[k]));
        }
        const glm::dvec3 more = link ? disc : glm::dvec3(0);
        if (glm::any(glm::greaterThan(least, high + more)) || glm::any(glm::lessThan(most, low - more)))
            continue;
        if (link && link_goes_through(obstacle.shape, part.edge, before, after))
            return true;
        for (const glm::dvec3& p : middle)
            if (goes_through(p, before, after))
                return true;
    }
    return false;
}

} // namespace taut
