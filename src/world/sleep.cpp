#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/islands.hpp"
#include "taut/world/sleep_impl.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taut {

/// Keeps the state of all, then makes the world of those that do not sleep.
void SleepWorld::Impl::plan_anew(const std::vector<bool>& now)
{
    collect(*world, vertices(), first.back(), carried);
    place(resting, world->positions(), world->plan(), awake, first);
    add(before, world->events());
    add(met_before, world->contacts());
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
    // As long as they have become: lists that are too short miss pairs for a step.
    options.world.plan.contact_capacity =
        std::max(options.world.plan.contact_capacity, world->plan().contact.capacity);
    world = std::make_unique<World>(with_bodies(scene, awake), device, options.world);
    carried.moved = program.values();
    deliver(*world, vertices(), awake, carried);
    ++changes;
}

double SleepWorld::Impl::margin(std::uint32_t body, const Extent& at) const
{
    const Body& of = scene.bodies[body];
    return std::max(of.material.thickness, meet ? radius_of(scene, of) : 0) + 0.05 * at.size();
}

/// By box of each body, as it is; those without places are left out.
std::vector<std::uint32_t> SleepWorld::Impl::islands_of(std::vector<Extent> boxes) const
{
    for (std::uint32_t b = 0; b < boxes.size(); ++b)
        boxes[b] = grown(boxes[b], margin(b, boxes[b]));
    return islands(boxes, [&](std::uint32_t a, std::uint32_t b) { return surfaces_meet(scene, a, b); });
}

/// A body falls asleep with all that it may touch, or not at all. A mesh that stands still joins nothing; it
/// is there for what moves, so it sleeps with the last of them.
void SleepWorld::Impl::keep_islands_awake(std::vector<bool>& now, const std::vector<glm::dvec3>& x) const
{
    std::vector<Extent> boxes(now.size());
    for (std::size_t own = 0; own < awake.size(); ++own)
        for (std::uint32_t k = world->plan().body_start[own];
             k < world->plan().body_start[own + 1] && !stands(awake[own]); ++k)
            boxes[awake[own]].take(x[k]);
    const std::vector<std::uint32_t> island = islands_of(boxes);
    std::vector<bool> moves(now.size(), false);
    for (const std::uint32_t b : awake)
        if (!now[b] && !stands(b))
            moves[island[b]] = true;
    bool any = false;
    for (const std::uint32_t b : awake)
        if (!stands(b))
        {
            now[b] = now[b] && !moves[island[b]];
            any = any || !now[b];
        }
    for (const std::uint32_t b : awake)
        now[b] = now[b] && !(any && stands(b));
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
    if (meet)
        keep_islands_awake(now, x);
    if (now != sleeping)
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
    if (wants_guarantee(my.scene))
        throw Error(
            ErrorCode::unsupported,
            "contact.guarantee is " + quoted(my.scene.contact.guarantee) +
                ", but what sleeps is looked for between steps, not within them; leave contact.guarantee "
                "out, or let all stay awake");
    my.meet = wants_contact(my.scene) && my.scene.contact.between;
    for (Body& body : my.scene.bodies)
        body.contact.meets_absent = takes_part(my.scene, body) && my.meet;
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

ContactCounts SleepWorld::contacts() const
{
    ContactCounts out = impl_->world->contacts();
    add(out, impl_->met_before);
    return out;
}

std::vector<BodyContactForce> SleepWorld::contact_forces() const
{
    std::vector<BodyContactForce> out = impl_->world->contact_forces();
    for (BodyContactForce& force : out)
    {
        force.a = impl_->awake[force.a];
        force.b = impl_->awake[force.b];
    }
    return out;
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
