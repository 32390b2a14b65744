// A body against a collider, by bounds of groups of elements, then by elements.
//
// Based on: Ericson. Real-Time Collision Detection. 2005, 5.1.3 (square of a distance to a box), 6.2 (what
//   its bounds keep away is not looked at); Mirtich. Impulse-based dynamic simulation of rigid body systems.
//   1996, section 2.3 (distance and speed tell when to look again).

#include "taut/report/close_look.hpp"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kGravityShare = 1.5 / 2; // taut_tunnel_bench misses nothing with it

/// Square of the distance from the box between `low` and `high` to the one between -half and half.
double square_apart(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& half)
{
    const glm::dvec3 gap = glm::max(glm::max(low - half, -half - high), glm::dvec3(0));
    return glm::dot(gap, gap);
}

/// Whether a hole wider than `width` may be there: the smallest ball round a triangle has at most 1 / sqrt(3)
/// of its longest edge.
bool hole_may_pass(double square_of_longest, double width)
{
    return square_of_longest > 2.999 * width * width;
}

double square_of_longest(const TriangleCorners& t)
{
    const glm::dvec3 a = t[1] - t[0], b = t[2] - t[1], c = t[0] - t[2];
    return std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
}

void into_frame(const ColliderFrame& frame, std::span<const std::uint32_t> vertices, std::size_t first,
                std::span<const glm::dvec3> x, std::vector<glm::dvec3>& out)
{
    for (const std::uint32_t i : vertices)
        out[i - first] = frame.inside(x[i]);
}

/// How far a group is at least, m, and the unit vector from the collider to it, in the world.
struct GroupGap
{
    double distance;
    glm::dvec3 away;
};

/// From the box of `half` in the frame: by a ball round the group, or by its bounds and a ball round the box,
/// whichever tells more.
GroupGap group_gap(const ColliderFrame& frame, const GroupMotion& motion, const glm::dvec3& half)
{
    const glm::dvec3 middle = frame.inside(motion.centre());
    const glm::dvec3 own = middle - glm::clamp(middle, -half, half);
    const double by_ball = glm::length(own) - motion.radius();
    const glm::dvec3 gap =
        glm::max(motion.low - frame.centre, 0.0) - glm::max(frame.centre - motion.high, 0.0);
    const double length = glm::length(gap), by_bounds = length - glm::length(half);
    if (std::max(by_ball, by_bounds) <= 0)
        return {0, glm::dvec3(0)};
    if (by_bounds >= by_ball)
        return {by_bounds, gap / length};
    return {by_ball, (own.x * frame.x + own.y * frame.y + own.z * frame.z) / glm::length(own)};
}

/// Whether elements of a group may be what LookFound counts: deep, or with a hole that the collider fits.
bool may_be_seen(const ColliderFrame& frame, const GroupMotion& motion, const SolidShape& shape,
                 const LookBounds& bounds)
{
    const double apart = group_gap(frame, motion, shape.half).distance;
    return apart <= 0.5 * shape.radius ||
           (apart <= shape.radius + bounds.speed * bounds.timestep &&
            hole_may_pass(4 * motion.radius() * motion.radius(), bounds.width));
}

/// The unit vector from the box of `half` to the one between `low` and `high`, along the line between their
/// nearest points, across which a plane has either on a side of its own; 0 where they meet.
glm::dvec3 direction(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& half)
{
    const glm::dvec3 gap = glm::max(low - half, 0.0) - glm::max(-half - high, 0.0);
    const double length = glm::length(gap);
    return length > 0 ? gap / length : gap;
}

/// m/s: neighbours pull, so a quarter of the body's speed at least.
double speed_towards(double own, const LookBounds& bounds, double led)
{
    return std::max(0.25 * bounds.speed, own) + led;
}

/// s: until what may go `own` (m/s) in any direction, and already goes `towards`, has made `distance`.
double time_for(double distance, double own, double towards, double gravity)
{
    return time_over(distance, 0.5 * (own + std::max(towards, -own)), gravity);
}

} // namespace

glm::dvec3 middle_half(const SolidShape& shape)
{
    return shape.radius > 0 ? shape.half : shape.half - shape.size;
}

double time_over(double distance, double speed, double gravity)
{
    if (!(distance > 0))
        return 0;
    const double root = std::sqrt(speed * speed + kGravityShare * gravity * distance);
    return root + speed > 0 ? distance / (root + speed) : kInfinite;
}

double way_over(double time, double speed, double gravity)
{
    return (2 * speed + kGravityShare * gravity * time) * time;
}

glm::dvec3 WatchedCollider::velocity(double time, double substep) const
{
    if (collider.motion.empty())
        return glm::dvec3(0);
    return (frame_at(collider, time + substep).centre - frame_at(collider, time).centre) / substep;
}

void CloseLook::order_groups(const WatchedBody& body, const WatchedCollider& collider,
                             std::span<const GroupMotion> motions, const LookMoment& now,
                             const LookBounds& bounds)
{
    const ColliderFrame frame = frame_at(collider.collider, now.time);
    const glm::dvec3 velocity = collider.velocity(now.time, now.substep);
    const glm::dvec3 middle = middle_half(collider.shape);
    const double led = body.led_speed + collider.led_speed, more = glm::length(velocity);
    order_.clear();
    const std::span<const ElementGroup> groups = body.groups.groups();
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
        if (groups[g].elements == 0)
            continue;
        const GroupGap gap = group_gap(frame, motions[g], middle);
        double back = kInfinite;
        for (const std::uint32_t i : body.groups.vertices(groups[g]))
            back = std::min(back, glm::dot(now.motion.v[i], gap.away));
        order_.emplace_back(time_for(gap.distance, speed_towards(motions[g].speed + more, bounds, led),
                                     led - back + glm::dot(velocity, gap.away), bounds.gravity),
                            g);
    }
    std::sort(order_.begin(), order_.end()); // the first leave the others less to look for
}

LookFound CloseLook::look(const WatchedBody& body, const WatchedCollider& collider,
                          std::span<const GroupMotion> motions, const LookMoment& now,
                          const LookBounds& bounds)
{
    order_groups(body, collider, motions, now, bounds);
    const ColliderFrame frame = frame_at(collider.collider, now.time);
    const glm::dvec3 velocity = collider.velocity(now.time, now.substep);
    after_.resize(body.count);
    velocities_.resize(body.count);
    LookFound out;
    out.clear = kInfinite;
    for (const auto& [soonest, g] : order_)
    {
        if (soonest >= out.clear && !may_be_seen(frame, motions[g], collider.shape, bounds))
            continue;
        const ElementGroup& group = body.groups.groups()[g];
        const std::span<const std::uint32_t> vertices = body.groups.vertices(group);
        into_frame(frame, vertices, body.first, now.motion.x, after_);
        for (const std::uint32_t i : vertices)
            velocities_[i - body.first] = frame.inside(frame.centre + (now.motion.v[i] - velocity));
        look_at_elements(body, collider, group, bounds, out);
    }
    return out;
}

/// Squares of distances throughout: most elements are far from everything, and need no root.
void CloseLook::look_at_elements(const WatchedBody& body, const WatchedCollider& collider,
                                 const ElementGroup& group, const LookBounds& bounds, LookFound& out)
{
    const SolidShape& shape = collider.shape;
    const glm::dvec3 middle = middle_half(shape);
    const double led = body.led_speed + collider.led_speed;
    const double reach = shape.radius + bounds.speed * bounds.timestep; // of what may arrive within a frame
    for (const ElementCorners& e : body.groups.elements(group))
    {
        const std::size_t k[] = {e[0] - body.first, e[1] - body.first, e[2] - body.first};
        const TriangleCorners at{after_[k[0]], after_[k[1]], after_[k[2]]};
        const glm::dvec3 low = glm::min(glm::min(at[0], at[1]), at[2]);
        const glm::dvec3 high = glm::max(glm::max(at[0], at[1]), at[2]);
        const double apart = square_apart(low, high, middle);
        const TriangleCorners v{velocities_[k[0]], velocities_[k[1]], velocities_[k[2]]};
        const double fastest = std::max({glm::dot(v[0], v[0]), glm::dot(v[1], v[1]), glm::dot(v[2], v[2])});
        const double own = speed_towards(std::sqrt(fastest), bounds, led);
        const double way = way_over(out.clear, own, bounds.gravity);
        if (apart < way * way || out.clear == kInfinite)
        {
            const glm::dvec3 away = direction(low, high, middle);
            const double back = std::min({glm::dot(v[0], away), glm::dot(v[1], away), glm::dot(v[2], away)});
            out.clear = std::min(out.clear, time_for(std::sqrt(apart), own, led - back, bounds.gravity));
        }
        const double distance = square_apart(low, high, shape.half);
        if (distance > reach * reach)
            continue;
        out.fits =
            out.fits || (hole_may_pass(square_of_longest(at), bounds.width) && hole_of(at) > bounds.width);
        if (distance > 0.25 * shape.radius * shape.radius || !lies_deep(shape, at, body.edge))
            continue;
        ++out.deep;
        if (bounds.depth)
            out.depth = std::max(out.depth, depth_of(shape, at));
    }
}

bool CloseLook::went_through(const WatchedBody& body, const WatchedCollider& collider,
                             std::span<const GroupMotion> motions, const LookMoment& now)
{
    const ColliderFrame then = frame_at(collider.collider, *now.last_time);
    const ColliderFrame frame = frame_at(collider.collider, now.time);
    const glm::dvec3 middle = middle_half(collider.shape);
    const bool moves = !collider.collider.motion.empty();
    const std::span<const ElementGroup> groups = body.groups.groups();
    before_.resize(body.count);
    after_.resize(body.count);
    middle_.clear();
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
        // A collider that stands sees the ways as they are, so most groups are passed over here.
        const double near = group_gap(frame, motions[g], middle).distance - 0.5 * collider.shape.size;
        if (groups[g].elements == 0 || (!moves && near > motions[g].way))
            continue;
        const std::span<const std::uint32_t> vertices = body.groups.vertices(groups[g]);
        into_frame(then, vertices, body.first, now.motion.last, before_);
        into_frame(frame, vertices, body.first, now.motion.x, after_);
        const auto far = [&](std::uint32_t i) {
            return glm::length(after_[i - body.first] - before_[i - body.first]) >= near;
        };
        if (near > 0 && std::none_of(vertices.begin(), vertices.end(), far))
            continue;
        if (middle_.empty())
            middle_ = middle_points(collider.shape, body.edge);
        if (group_went_through(body, collider, groups[g]))
            return true;
    }
    return false;
}

bool CloseLook::group_went_through(const WatchedBody& body, const WatchedCollider& collider,
                                   const ElementGroup& group) const
{
    glm::dvec3 low = middle_.front(), high = low;
    for (const glm::dvec3& p : middle_)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 disc(0.5 * collider.shape.size); // what links find where the middle is a point
    for (const ElementCorners& e : body.groups.elements(group))
    {
        const bool link = e[1] == e[2];
        TriangleCorners before, after;
        glm::dvec3 least(kInfinite), most(-kInfinite);
        for (std::size_t k = 0; k < 3; ++k)
        {
            before[k] = before_[e[k] - body.first];
            after[k] = after_[e[k] - body.first];
            least = glm::min(least, glm::min(before[k], after[k]));
            most = glm::max(most, glm::max(before[k], after[k]));
        }
        const glm::dvec3 more = link ? disc : glm::dvec3(0);
        if (glm::any(glm::greaterThan(least, high + more)) || glm::any(glm::lessThan(most, low - more)))
            continue;
        if (link && link_goes_through(collider.shape, body.edge, before, after))
            return true;
        for (const glm::dvec3& p : middle_)
            if (goes_through(p, before, after))
                return true;
    }
    return false;
}

} // namespace taut
