// Bodies against colliders from one look to the next.
//
// Based on: Provot. Collision and self-collision handling in cloth model dedicated to design garments. 1997
//   (motion in straight lines between two moments); Mirtich. Impulse-based dynamic simulation of rigid body
//   systems. 1996, section 2.3 (distance and speed tell when to look again).
// Departures: what counts is that a surface goes through the middle of a collider, not that it touches it.

#include "taut/report/crossing.hpp"

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

/// The furthest that any point moved.
double furthest(std::span<const glm::dvec3> before, std::span<const glm::dvec3> after)
{
    double square = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        square = std::max(square, glm::dot(after[i] - before[i], after[i] - before[i]));
    return std::sqrt(square);
}

bool finite(const glm::dvec3& p) { return std::isfinite(p.x + p.y + p.z); }

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

CrossingWatch::Bounds CrossingWatch::bounds_of(const Part& part, std::span<const glm::dvec3> x) const
{
    Bounds out{x[part.first], x[part.first]};
    for (const glm::dvec3& p : x.subspan(part.first, part.count))
    {
        out.low = glm::min(out.low, p);
        out.high = glm::max(out.high, p);
        out.finite = out.finite && finite(p);
    }
    return out;
}

/// The fastest that a vertex and the collider move towards or past each other.
double CrossingWatch::speed_of(const Part& part, const Obstacle& obstacle, const Moment& now) const
{
    const double step = now.substep;
    const glm::dvec3 collider =
        (frame_at(obstacle.collider, now.time + step).centre - frame_at(obstacle.collider, now.time).centre) /
        step;
    double square = 0;
    for (std::size_t i = part.first; i < part.first + part.count; ++i)
    {
        const glm::dvec3 relative = now.v[i] - collider;
        square = std::max(square, glm::dot(relative, relative));
    }
    return std::sqrt(square);
}

/// Half of how wide the collider is to a body that comes as its mean motion says.
double CrossingWatch::width_of(const Part& part, const Obstacle& obstacle, const Moment& now) const
{
    const ColliderFrame frame = frame_at(obstacle.collider, now.time);
    glm::dvec3 way(0);
    for (std::size_t i = part.first; i < part.first + part.count; ++i)
        way += now.v[i];
    way = way / static_cast<double>(part.count) * now.substep;
    way -= frame_at(obstacle.collider, now.time + now.substep).centre - frame.centre;
    const double length = glm::length(way);
    return width_across(obstacle.shape,
                        length > 0 ? frame.inside(frame.centre + way) / length : glm::dvec3(0));
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
        for (std::size_t o = 0; o < obstacles_.size(); ++o)
            if (!parts_[p].elements.empty())
                look_at(parts_[p], obstacles_[o], pairs_[p * obstacles_.size() + o], now);
    found_.elements = std::max(found_.elements, elements_);
    last_.assign(positions.begin(), positions.end());
    last_time_ = time;
    first_ = false;
}

void CrossingWatch::look_at(const Part& part, const Obstacle& obstacle, Pair& pair, const Moment& now)
{
    const Bounds bounds = bounds_of(part, now.x);
    if (!bounds.finite)
        return;
    const double speed = speed_of(part, obstacle, now);
    const glm::dvec3 centre = frame_at(obstacle.collider, now.time).centre;
    double distance = bounds.distance(centre) - obstacle.shape.reach;
    const double away = distance;
    if (last_time_)
    {
        // What swept past in between lies within the bounds of both moments, as the collider sees them.
        const Bounds before = bounds_of(part, last_);
        const glm::dvec3 was = frame_at(obstacle.collider, *last_time_).centre;
        const Bounds both{glm::min(bounds.low - centre, before.low - was),
                          glm::max(bounds.high - centre, before.high - was)};
        distance = std::min(distance, both.distance(glm::dvec3(0)) - obstacle.shape.reach);
    }
    if (distance <= speed * timestep_)
        look_closely(part, obstacle, pair, now, speed);
    else
    {
        pair.inside = false;
        clear_ = std::min(clear_, time_over(away, speed + part.led_speed + obstacle.led_speed, gravity_));
    }
}

void CrossingWatch::look_closely(const Part& part, const Obstacle& obstacle, Pair& pair, const Moment& now,
                                 double speed)
{
    const SolidShape& shape = obstacle.shape;
    const auto into_frame = [&](std::span<const glm::dvec3> x, double time, std::vector<glm::dvec3>& out) {
        const ColliderFrame frame = frame_at(obstacle.collider, time);
        out.resize(part.count);
        for (std::size_t i = 0; i < part.count; ++i)
            out[i] = frame.inside(x[part.first + i]);
    };
    into_frame(now.x, now.time, after_);
    if (last_time_)
        into_frame(last_, *last_time_, before_);

    const glm::dvec3 middle = shape.radius > 0 ? shape.half : shape.half - shape.size;
    // Squares of distances: most elements are far from everything, and need no root.
    double nearest = std::numeric_limits<double>::infinity(); // of a surface to the middle, at least
    std::uint64_t deep = 0;
    bool fits = false;
    const double width = kTunnelHole * (width_of(part, obstacle, now) + part.gap);
    const double reach = shape.radius + speed * timestep_; // of what may arrive within a frame
    for (const auto& e : part.elements)
    {
        const TriangleCorners now_at{after_[e[0] - part.first], after_[e[1] - part.first],
                                     after_[e[2] - part.first]};
        const glm::dvec3 low = glm::min(glm::min(now_at[0], now_at[1]), now_at[2]);
        const glm::dvec3 high = glm::max(glm::max(now_at[0], now_at[1]), now_at[2]);
        nearest = std::min(nearest, square_apart(low, high, middle));
        const double distance = square_apart(low, high, shape.half);
        if (distance > reach * reach)
            continue;
        fits = fits || hole_of(now_at) > width;
        if (distance <= 0.25 * shape.radius * shape.radius && lies_deep(shape, now_at, part.edge))
        {
            ++deep;
            if (!pair.inside && !first_)
                found_.depth = std::max(found_.depth, depth_of(shape, now_at));
        }
    }
    nearest = std::sqrt(nearest);
    pair.inside = deep > 0 && (pair.inside || first_);
    const bool through = last_time_ && !pair.inside &&
                         nearest <= furthest(before_, after_) + 0.5 * shape.size &&
                         went_through(part, obstacle);
    if (deep > 0 && !pair.inside)
        elements_ += deep;
    found_.passed += through;
    if (through || (deep > 0 && !pair.inside))
        note(found_.seen, pair.seen, part, obstacle, now, through);
    if (fits || speed * now.substep > kTunnelTravel * shape.size)
    {
        ++found_.may_tunnel;
        note(found_.likely, pair.likely, part, obstacle, now, false);
    }
    clear_ = std::min(clear_, time_over(nearest, speed + part.led_speed + obstacle.led_speed, gravity_));
}

bool CrossingWatch::went_through(const Part& part, const Obstacle& obstacle) const
{
    const std::vector<glm::dvec3> middle = middle_points(obstacle.shape, part.edge);
    glm::dvec3 low = middle.front(), high = low;
    for (const glm::dvec3& p : middle)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 disc(0.5 * obstacle.shape.size); // what links find where the middle is a point
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
