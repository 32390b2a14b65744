// What wakes bodies that sleep, and which wake with them.

#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/islands.hpp"
#include "taut/world/sleep_impl.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

/// Of a ball round a collider's own point that it lies within; 0 of one without bounds.
double reach(const Collider& c)
{
    const ColliderSolid solid = solid_of(c);
    const double off = glm::distance(c.point, rest_frame(c).centre);
    return solid.bounded ? off + glm::length(solid.half) + solid.radius : 0;
}

/// Whether a collider that moves between two times can come within `margin` of a box.
bool comes_near(const Collider& c, double from, double to, const Extent& box, double margin)
{
    const glm::dvec3 before = pose(c.motion, from, c.point), after = pose(c.motion, to, c.point);
    // A turn moves the far ends of three arms as long as the collider; no turn leaves all of them.
    double moved = glm::distance(before, after);
    for (int axis = 0; axis < 3; ++axis)
    {
        glm::dvec3 arm = c.point;
        arm[axis] += reach(c);
        moved = std::max(moved, glm::distance(pose(c.motion, from, arm), pose(c.motion, to, arm)));
    }
    if (!(moved > 0))
        return false;
    if (c.kind == ColliderKind::plane)
    {
        const glm::dvec3 n = glm::normalize(c.normal);
        const glm::dvec3 nearest(n.x > 0 ? box.low.x : box.high.x, n.y > 0 ? box.low.y : box.high.y,
                                 n.z > 0 ? box.low.z : box.high.z);
        return std::min(glm::dot(n, nearest - before), glm::dot(n, nearest - after)) < margin;
    }
    const glm::dvec3 inside = glm::clamp(before, box.low, box.high);
    return glm::distance(inside, before) < reach(c) + moved + margin;
}

bool pins_move(const Body& body, double from, double to)
{
    const auto& x = held_rest_of(body);
    return std::any_of(body.pins.begin(), body.pins.end(), [&](const Pin& pin) {
        for (std::size_t k = 0; k < pin.vertices.size(); ++k)
            if (const glm::dvec3& rest = x[pin.vertices[k]];
                held_at(pin, from, k, rest) != held_at(pin, to, k, rest))
                return true;
        return false;
    });
}

} // namespace

/// By keys of this step, or by the program.
bool SleepWorld::Impl::led_now(std::uint32_t body) const
{
    const double from = world->time();
    return program.pins_move(body) || pins_move(scene.bodies[body], from, from + scene.timestep);
}

/// Its number among those that are awake.
std::size_t SleepWorld::Impl::wake(std::size_t body, const char* who)
{
    if (body >= sleeping.size())
        throw Error(ErrorCode::bad_input, std::string(who) + ": body " + std::to_string(body) + " of " +
                                              std::to_string(sleeping.size()) + ", numbered from 0");
    if (sleeping[body])
        let_go_on({static_cast<std::uint32_t>(body)});
    quiet[body] = 0;
    return static_cast<std::size_t>(std::find(awake.begin(), awake.end(), static_cast<std::uint32_t>(body)) -
                                    awake.begin());
}

/// They wake, and what they may touch with them; so do all meshes that are led.
void SleepWorld::Impl::let_go_on(const std::vector<std::uint32_t>& bodies)
{
    std::vector<bool> now = sleeping;
    std::vector<Extent> boxes = box;
    for (std::uint32_t b = 0; b < boxes.size(); ++b)
        if (scene.bodies[b].kinematic.used && std::find(bodies.begin(), bodies.end(), b) == bodies.end())
            boxes[b] = Extent(); // it stands, and joins nothing
    const std::vector<std::uint32_t> island = meet ? islands_of(boxes) : std::vector<std::uint32_t>();
    for (const std::uint32_t body : bodies)
        for (std::uint32_t b = 0; b < now.size(); ++b)
            if (b == body || (meet && (island[b] == island[body] || scene.bodies[b].kinematic.used)))
                now[b] = false;
    plan_anew(now);
}

/// Where a body that is awake may come in the next step: twice as far as its speeds take it, and where it is
/// led.
Extent SleepWorld::Impl::way_of(std::size_t own, const std::vector<glm::dvec3>& x,
                                const std::vector<glm::dvec3>& v) const
{
    const std::uint32_t b = awake[own], begin = world->plan().body_start[own];
    const double h = scene.timestep, to = world->time() + h;
    Extent out;
    for (std::uint32_t k = begin; k < world->plan().body_start[own + 1]; ++k)
    {
        out.take(x[k]);
        out.take(x[k] + 2 * h * v[k]);
    }
    for (const Pin& pin : scene.bodies[b].pins)
        for (std::size_t k = 0; k < pin.vertices.size() && is_led(pin) && !pin.moved_by_program; ++k)
            out.take(held_at(pin, to, k, held_rest_of(scene.bodies[b])[pin.vertices[k]]));
    for (const PinMove& move : program.values().pins)
        for (std::size_t k = 0; k < move.to.size() && move.body == b; ++k)
            out.take(move.to[k]);
    return grown(out, margin(b, out) + glm::length(scene.gravity) * h * h);
}

/// Sleeping bodies that one that is awake may come near in the next step.
void SleepWorld::Impl::add_approached(std::vector<std::uint32_t>& disturbed) const
{
    if (std::all_of(awake.begin(), awake.end(), [&](std::uint32_t b) { return stands(b); }))
        return; // nothing is read from the device for them
    const std::vector<glm::dvec3> x = world->positions(), v = world->velocities();
    for (std::size_t own = 0; own < awake.size(); ++own)
    {
        const std::uint32_t b = awake[own];
        const Extent way = stands(b) ? Extent() : way_of(own, x, v);
        for (std::uint32_t s = 0; s < sleeping.size(); ++s)
            if (sleeping[s] && overlap(way, grown(box[s], margin(s))) && surfaces_meet(scene, b, s))
                disturbed.push_back(s);
    }
}

void SleepWorld::Impl::wake_the_disturbed()
{
    const double from = world->time(), to = from + scene.timestep;
    program.begin_step(scene, from, to);
    if (awake.size() == sleeping.size())
        return;
    std::vector<std::uint32_t> disturbed;
    for (const std::uint32_t b : led)
        if (sleeping[b] && pins_move(scene.bodies[b], from, to))
            disturbed.push_back(b);
    for (std::uint32_t b = 0; b < sleeping.size(); ++b)
        if (sleeping[b] && program.pins_move(b))
            disturbed.push_back(b);
    for (const Collider& c : scene.colliders)
        for (std::uint32_t b = 0; b < sleeping.size() && !c.motion.empty(); ++b)
            if (sleeping[b] && comes_near(c, from, to, box[b], margin(b)))
                disturbed.push_back(b);
    if (meet)
        add_approached(disturbed);
    if (!disturbed.empty())
        let_go_on(disturbed);
}

} // namespace taut
