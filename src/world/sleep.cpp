#include "taut/world/sleep.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/collider.hpp"
#include "taut/scene/extent.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/carry.hpp"
#include "taut/world/moved.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

struct SleepWorld::Impl
{
    Scene scene;
    SleepOptions options;
    std::shared_ptr<Device> device;
    std::vector<std::uint32_t> first; ///< scene-wide vertex of each body, and the total
    std::vector<std::uint32_t> awake; ///< bodies
    std::vector<bool> sleeping;
    std::vector<std::uint32_t> quiet; ///< looks in a row, by body
    std::vector<double> threshold;    ///< m/s, by body; 0 = never sleeps
    CarriedState carried;             ///< of those that sleep, as they fell asleep
    std::vector<glm::dvec3> resting;  ///< m, where they lie; scene-wide
    std::vector<glm::dvec3> seen;     ///< m, at the last look
    std::vector<Extent> box;          ///< of those that sleep
    std::vector<std::uint32_t> led;   ///< bodies with a pin that has a motion
    Moved program;
    std::unique_ptr<World> world;
    Events before;
    std::uint64_t steps = 0, changes = 0;

    std::vector<std::uint32_t> vertices() const { return scene_vertices(world->plan(), awake, first); }
    void plan_anew(const std::vector<bool>& now);
    void look();
    void wake_the_disturbed();
    std::size_t wake(std::size_t body, const char* who);
    double margin(std::uint32_t body) const;
};

/// Keeps the state of all, then makes the world of those that do not sleep.
void SleepWorld::Impl::plan_anew(const std::vector<bool>& now)
{
    collect(*world, vertices(), first.back(), carried);
    place(resting, world->positions(), world->plan(), awake, first);
    add(before, world->events());
    sleeping = now;
    awake.clear();
    for (std::uint32_t b = 0; b < sleeping.size(); ++b)
    {
        quiet[b] = sleeping[b] ? quiet[b] : 0;
        box[b] = Extent();
        for (std::uint32_t v = first[b]; v < first[b + 1] && sleeping[b]; ++v)
            box[b].take(resting[v]);
        if (!sleeping[b])
            awake.push_back(b);
    }
    world = std::make_unique<World>(with_bodies(scene, awake), device, options.world);
    carried.moved = program.values();
    deliver(*world, vertices(), awake, carried);
    ++changes;
}

/// Counts quiet looks, and lets those sleep that have had enough of them.
void SleepWorld::Impl::look()
{
    const std::vector<glm::dvec3> v = world->velocities(), x = world->positions();
    std::vector<bool> now = sleeping;
    for (std::size_t own = 0; own < awake.size(); ++own)
    {
        const std::uint32_t b = awake[own];
        // What is no number is not quiet; and what swings is fast between two looks, so it is elsewhere.
        const double far = threshold[b] * static_cast<double>(options.look_every) * scene.timestep;
        bool rests = true;
        for (std::uint32_t k = world->plan().body_start[own]; k < world->plan().body_start[own + 1]; ++k)
        {
            glm::dvec3& last = seen[first[b] + (k - world->plan().body_start[own])];
            const bool near = quiet[b] == 0 || glm::distance(x[k], last) < far;
            rests = rests && near && glm::length(v[k]) < threshold[b];
            last = x[k];
        }
        quiet[b] = rests ? quiet[b] + 1 : 0;
        now[b] = quiet[b] >= options.quiet_looks;
    }
    if (now != sleeping)
        plan_anew(now);
}

/// Its number among those that are awake.
std::size_t SleepWorld::Impl::wake(std::size_t body, const char* who)
{
    if (body >= sleeping.size())
        throw Error(ErrorCode::bad_input, std::string(who) + ": body " + std::to_string(body) + " of " +
                                              std::to_string(sleeping.size()) + ", numbered from 0");
    if (sleeping[body])
    {
        std::vector<bool> now = sleeping;
        now[body] = false;
        plan_anew(now);
    }
    quiet[body] = 0;
    return static_cast<std::size_t>(std::find(awake.begin(), awake.end(), static_cast<std::uint32_t>(body)) -
                                    awake.begin());
}

double SleepWorld::Impl::margin(std::uint32_t body) const
{
    return scene.bodies[body].material.thickness + 0.05 * box[body].size();
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
    if (disturbed.empty())
        return;
    std::vector<bool> now = sleeping;
    for (const std::uint32_t b : disturbed)
        now[b] = false;
    plan_anew(now);
}

SleepWorld::SleepWorld(const Scene& scene, std::shared_ptr<Device> device, const SleepOptions& options)
    : impl_(std::make_unique<Impl>())
{
    Impl& my = *impl_;
    my.options = options;
    my.device = std::move(device);
    my.world = std::make_unique<World>(scene, my.device, options.world);
    my.scene = my.world->scene();
    if (!my.world->plan().kept.empty())
        throw Error(ErrorCode::unsupported,
                    "method " + quoted(my.scene.method.type) +
                        " keeps more than places and speeds from step to step; bodies "
                        "under it cannot sleep");
    if (!my.world->plan().solvers.empty())
        throw Error(ErrorCode::unsupported,
                    "method " + quoted(my.scene.method.type) +
                        " solves for all bodies as one system, so one that is not "
                        "there would change the others; bodies under it cannot sleep");
    if (wants_contact(my.scene))
        throw Error(ErrorCode::unsupported,
                    "bodies that meet each other or themselves cannot sleep yet; leave "
                    "contact out, or let all stay awake");
    // The stiffest body may be the one that sleeps; the others keep its substeps.
    my.scene.method.substeps = my.world->plan().substeps;
    const double gravity = glm::length(my.scene.gravity) > 0 ? glm::length(my.scene.gravity) : 9.81;
    my.first.push_back(0);
    for (const Body& body : my.scene.bodies)
    {
        if (body.material.tear_strain > 0)
            throw Error(ErrorCode::unsupported, "cloth that can tear cannot sleep; leave tear_strain out");
        my.first.push_back(my.first.back() + static_cast<std::uint32_t>(body.mesh.positions.size()));
        Extent rest;
        for (const glm::dvec3& x : body.mesh.positions)
            rest.take(x);
        const bool windy =
            my.scene.wind.density > 0 && (body.material.drag > 0 || body.material.friction_drag > 0);
        my.threshold.push_back(windy ? 0 : options.quiet_speed * std::sqrt(gravity * rest.size()));
    }
    my.program.start(my.scene);
    moved_ = &my.program;
    const std::size_t count = my.scene.bodies.size();
    for (std::uint32_t b = 0; b < count; ++b)
        if (std::any_of(my.scene.bodies[b].pins.begin(), my.scene.bodies[b].pins.end(),
                        [](const Pin& pin) { return is_led(pin) && !pin.moved_by_program; }))
            my.led.push_back(b);
    my.awake.resize(count);
    std::iota(my.awake.begin(), my.awake.end(), 0u);
    my.sleeping.assign(count, false);
    my.quiet.assign(count, 0);
    my.box.resize(count);
    my.resting.resize(my.first.back());
    my.seen.resize(my.first.back());
}

SleepWorld::~SleepWorld() = default;
SleepWorld::SleepWorld(SleepWorld&&) noexcept = default;
SleepWorld& SleepWorld::operator=(SleepWorld&&) noexcept = default;

void SleepWorld::step()
{
    Impl& my = *impl_;
    if (my.steps > 0 && my.steps % std::max<std::uint64_t>(my.options.look_every, 1) == 0)
        my.look();
    my.wake_the_disturbed();
    if (!my.program.idle())
        Moved::of(*my.world).obey(part_of(my.program.values(), my.awake));
    my.world->step();
    my.program.end_step(my.scene.timestep);
    ++my.steps;
}

std::uint64_t SleepWorld::steps() const { return impl_->steps; }
double SleepWorld::time() const { return impl_->world->time(); }
const Scene& SleepWorld::scene() const { return impl_->scene; }
const World& SleepWorld::awake() const { return *impl_->world; }
std::uint64_t SleepWorld::changes() const { return impl_->changes; }
bool SleepWorld::asleep(std::size_t body) const { return impl_->sleeping.at(body); }

std::size_t SleepWorld::asleep() const
{
    return static_cast<std::size_t>(std::count(impl_->sleeping.begin(), impl_->sleeping.end(), true));
}

std::vector<glm::dvec3> SleepWorld::positions() const
{
    std::vector<glm::dvec3> out = impl_->resting;
    place(out, impl_->world->positions(), impl_->world->plan(), impl_->awake, impl_->first);
    return out;
}

std::vector<glm::dvec3> SleepWorld::velocities() const
{
    std::vector<glm::dvec3> out(impl_->first.back(), glm::dvec3(0));
    place(out, impl_->world->velocities(), impl_->world->plan(), impl_->awake, impl_->first);
    return out;
}

Events SleepWorld::events() const
{
    Events sum = impl_->before;
    add(sum, impl_->world->events());
    return sum;
}

void SleepWorld::set_force(std::uint32_t vertex, const glm::dvec3& force)
{
    Impl& my = *impl_;
    if (vertex >= my.first.back())
        throw Error(ErrorCode::bad_input, "vertex " + std::to_string(vertex) +
                                              " is not there; the scene has " +
                                              std::to_string(my.first.back()) + ", numbered from 0");
    const auto body = static_cast<std::size_t>(std::upper_bound(my.first.begin(), my.first.end(), vertex) -
                                               my.first.begin() - 1);
    const std::size_t own = my.wake(body, "set_force");
    my.world->set_force(my.world->plan().body_start[own] + (vertex - my.first[body]), force);
}

void SleepWorld::set_positions(std::size_t body, std::span<const glm::dvec3> positions)
{
    const std::size_t own = impl_->wake(body, "set_positions");
    impl_->world->set_positions(own, positions);
}

void SleepWorld::set_velocities(std::size_t body, std::span<const glm::dvec3> velocities)
{
    const std::size_t own = impl_->wake(body, "set_velocities");
    impl_->world->set_velocities(own, velocities);
}

void SleepWorld::copy_into(World& whole) const
{
    const Impl& my = *impl_;
    CarriedState all = my.carried;
    collect(*my.world, my.vertices(), my.first.back(), all);
    std::vector<std::uint32_t> bodies(my.scene.bodies.size());
    std::iota(bodies.begin(), bodies.end(), 0u);
    all.moved = my.program.values();
    deliver(whole, scene_vertices(whole.plan(), bodies, my.first), bodies, all);
}

} // namespace taut
