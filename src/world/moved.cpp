// What the program moves, from order to order: the scene of each step gets it as keyframes.

#include "taut/world/moved.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace taut {
namespace {

bool same_pose(const Keyframe& a, const Keyframe& b)
{
    return a.translate == b.translate && a.rotate_axis == b.rotate_axis &&
           a.rotate_degrees == b.rotate_degrees && a.rotate_centre == b.rotate_centre;
}

Keyframe at(double time, Keyframe pose)
{
    pose.time = time;
    return pose;
}

bool stands(const MoverTrack& track)
{
    return std::all_of(track.velocity.begin(), track.velocity.end(),
                       [](const glm::dvec3& v) { return v == glm::dvec3(0); });
}

std::vector<PinMove> pins_at_rest(const Scene& scene)
{
    std::vector<PinMove> out;
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
    {
        const Body& body = scene.bodies[b];
        const auto& start = start_of(body);
        for (std::uint32_t p = 0; p < body.pins.size(); ++p)
        {
            if (!body.pins[p].moved_by_program)
                continue;
            PinMove move{b, p, {}, {}, {}, {}};
            for (const std::uint32_t v : body.pins[p].vertices)
                move.rest.push_back(start[v]);
            move.from = move.to = move.rest;
            out.push_back(std::move(move));
        }
    }
    return out;
}

/// Where the middle of a collider is to be going on from where it is.
void go_on(ColliderMove& move, const Scene& scene)
{
    const glm::dvec3 middle = rest_frame(scene.colliders[move.collider]).centre;
    move.from = about(move.from, middle);
    move.to = moved_on(move.from, middle, move.velocity, move.turn, scene.timestep);
    take_short_way(move.from, move.to);
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(const Keyframe& pose)
{
    return finite(pose.translate) && finite(pose.rotate_axis) && finite(pose.rotate_centre) &&
           std::isfinite(pose.rotate_degrees);
}

bool finite(const ColliderMove& m)
{
    return finite(m.from) && finite(m.to) && finite(m.velocity) && finite(m.turn);
}

bool all_finite(const std::vector<glm::dvec3>& places)
{
    return std::all_of(places.begin(), places.end(), [](const glm::dvec3& x) { return finite(x); });
}

bool fits(const PinMove& move, const PinMove& own)
{
    return move.body == own.body && move.pin == own.pin && move.rest.size() == own.rest.size() &&
           move.from.size() == own.rest.size() && move.to.size() == own.rest.size() &&
           all_finite(move.rest) && all_finite(move.from) && all_finite(move.to);
}

void no_longer_moved(Scene& scene)
{
    for (Collider& c : scene.colliders)
        if (c.moved_by_program)
        {
            c.motion.clear();
            c.moved_by_program = false;
        }
}

} // namespace

void Moved::start(Scene& scene)
{
    scene_ = &scene;
    values_ = {};
    values_.pins = pins_at_rest(scene);
    for (std::uint32_t c = 0; c < scene.colliders.size(); ++c)
        if (scene.colliders[c].moved_by_program && !scene.colliders[c].motion.empty())
        {
            const Keyframe pose = scene.colliders[c].motion.back();
            scene.colliders[c].motion = {pose};
            ColliderMove move;
            move.collider = c;
            move.from = move.to = pose;
            values_.colliders.push_back(move);
        }
    Extent all;
    for (const Body& body : scene.bodies)
        for (const glm::dvec3& x : body.mesh.positions)
            all.take(x);
    diameter_ = all.size();
}

void Moved::check(const Scene& scene, const ProgramMotion& values) const
{
    bool good = values.pins.empty() || values.pins.size() == values_.pins.size();
    for (std::size_t p = 0; good && p < values.pins.size(); ++p)
        good = fits(values.pins[p], values_.pins[p]);
    for (std::size_t k = 0; good && k < values.colliders.size(); ++k)
    {
        const ColliderMove& move = values.colliders[k];
        good = move.collider < scene.colliders.size() && finite(move) &&
               (k == 0 || values.colliders[k - 1].collider < move.collider);
        if (good)
        {
            const Collider& c = scene.colliders[move.collider];
            good = c.moved_by_program || c.motion.empty();
        }
    }
    good = good && (!values.wind || (finite(values.wind->from) && finite(values.wind->to)));
    if (!good)
        throw Error(ErrorCode::bad_input,
                    "restore: what the program has moved holds a value that is not finite, "
                    "or is of another scene");
}

void Moved::assign(Scene& scene, const ProgramMotion& values)
{
    no_longer_moved(scene);
    if (values_.wind && !values.wind)
        scene.wind.keys.clear();
    const bool pins = !values.pins.empty();
    values_ = values;
    if (!pins)
        values_.pins = pins_at_rest(scene);
    for (const ColliderMove& move : values_.colliders)
    {
        scene.colliders[move.collider].motion = {move.from};
        scene.colliders[move.collider].moved_by_program = true;
    }
    settled_ = false;
}

void Moved::tear(const Scene& before, const Scene& now, std::span<const std::uint32_t> origin)
{
    std::uint32_t first_now = 0, first_before = 0;
    std::size_t next = 0;
    for (std::uint32_t b = 0; b < now.bodies.size(); ++b)
    {
        for (; next < values_.pins.size() && values_.pins[next].body == b; ++next)
        {
            PinMove& move = values_.pins[next];
            const auto& had = before.bodies[b].pins[move.pin].vertices;
            const auto& has = now.bodies[b].pins[move.pin].vertices;
            for (std::size_t k = had.size(); k < has.size(); ++k)
            {
                const std::uint32_t own = origin[first_now + has[k]] - first_before;
                const auto at =
                    static_cast<std::size_t>(std::find(had.begin(), had.end(), own) - had.begin());
                for (std::vector<glm::dvec3>* places : {&move.rest, &move.from, &move.to})
                    places->push_back(glm::dvec3((*places)[at]));
            }
        }
        first_now += static_cast<std::uint32_t>(now.bodies[b].mesh.positions.size());
        first_before += static_cast<std::uint32_t>(before.bodies[b].mesh.positions.size());
    }
}

bool Moved::begin_step(Scene& scene, double from, double to)
{
    bool moving = false;
    for (ColliderMove& move : values_.colliders)
    {
        if (move.goes_on)
            go_on(move, scene);
        Collider& collider = scene.colliders[move.collider];
        collider.motion = {at(from, move.from), at(to, move.to)};
        collider.moved_by_program = true;
        moving = moving || !same_pose(move.from, move.to);
    }
    for (const PinMove& move : values_.pins)
        moving = moving || move.from != move.to;
    if (values_.wind)
    {
        scene.wind.keys = {{from, values_.wind->from}, {to, values_.wind->to}};
        moving = moving || values_.wind->from != values_.wind->to;
    }
    const bool differs = moving || !settled_;
    settled_ = !moving;
    return differs;
}

void Moved::end_step(double seconds)
{
    for (ColliderMove& move : values_.colliders)
    {
        if (!same_pose(move.from, move.to) || !stands(move.track))
        {
            const std::vector<Keyframe> motion{at(0, move.from), at(seconds, move.to)};
            follow(move.track, motion, collider_corners(scene_->colliders[move.collider], diameter_), 0,
                   seconds, chords(motion, 0, seconds));
        }
        move.from = move.to;
        if (move.goes_on)
            go_on(move, *scene_);
    }
    for (PinMove& move : values_.pins)
        if (move.from != move.to || !stands(move.track))
        {
            follow(move.track, move.from, move.to, move.rest, seconds);
            move.from = move.to;
        }
    if (values_.wind)
    {
        WindMove& wind = *values_.wind;
        wind.fastest = std::max({wind.fastest, glm::length(wind.from), glm::length(wind.to)});
        wind.from = wind.to;
    }
}

bool Moved::pins_move(std::size_t body) const
{
    return std::any_of(values_.pins.begin(), values_.pins.end(),
                       [&](const PinMove& m) { return m.body == body && m.from != m.to; });
}

ProgramMotion part_of(const ProgramMotion& whole, const std::vector<std::uint32_t>& bodies)
{
    ProgramMotion out = whole;
    out.pins.clear();
    for (std::uint32_t own = 0; own < bodies.size(); ++own)
        for (const PinMove& move : whole.pins)
            if (move.body == bodies[own])
            {
                out.pins.push_back(move);
                out.pins.back().body = own;
            }
    return out;
}

} // namespace taut
