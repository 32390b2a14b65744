// What a world knows of surfaces that meet, and lists of them that grow between steps.

#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact_scene.hpp"
#include "taut/world/held_pairs.hpp"
#include "taut/world/planned.hpp"
#include "taut/world/world_impl.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace taut {
namespace {

/// The least power of two above twice the pairs found: the next steps are likely to find more.
std::uint32_t roomy(std::uint32_t found)
{
    std::uint32_t capacity = 1;
    while (capacity <= 2 * std::uint64_t(found) && capacity < kMostContactPairs)
        capacity *= 2;
    return capacity;
}

/// Sides and multipliers of the pairs that are listed. A multiplier is a force times the square of the
/// substep (contact_push.comp).
template <typename Real>
void add_sides(Device& device, const BufferPtr& side, const BufferPtr& taken, double substep,
               std::vector<SurfacePair>& pairs)
{
    const auto count = static_cast<std::uint32_t>(pairs.size());
    const auto sides = device.read<layout::ContactSide<Real>>(side, count);
    const auto multipliers = device.read<glm::vec<4, Real>>(taken, 2 * count);
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const glm::dvec4 force = glm::dvec4(multipliers[2 * k]) / (substep * substep);
        pairs[k].rest_gap = static_cast<double>(sides[k].rest_gap);
        pairs[k].normal = {sides[k].normal_x, sides[k].normal_y, sides[k].normal_z};
        pairs[k].push = force.w;
        pairs[k].friction = glm::dvec3(force);
    }
}

/// The body of each vertex of a scene.
std::vector<std::uint32_t> bodies_of(const Scene& scene)
{
    std::vector<std::uint32_t> out;
    for (std::uint32_t b = 0; b < scene.bodies.size(); ++b)
        out.resize(out.size() + scene.bodies[b].mesh.positions.size(), b);
    return out;
}

} // namespace

ContactLists World::Impl::contact_lists() const
{
    if (plan.contact.control == kNoBuffer)
        return {};
    return {raw(plan.contact.control), raw(plan.contact.lost),
            raw(plan.contact.pair),    raw(plan.contact.side),
            raw(plan.contact.taken),   raw(plan.contact.corner_start),
            raw(plan.contact.corner),  held_pairs()};
}

/// Lists only where vertices have kept their numbers; else what friction holds.
void World::Impl::carry_contacts(const ContactLists& before, const std::vector<std::uint32_t>& from,
                                 bool same_vertices)
{
    if (plan.contact.control == kNoBuffer || before.control.empty())
        return;
    std::vector<std::byte> control = before.control;
    if (same_vertices)
    {
        device->write(buffers[plan.contact.pair], 0, before.pair);
        device->write(buffers[plan.contact.side], 0, before.side);
        device->write(buffers[plan.contact.taken], 0, before.taken);
        device->write(buffers[plan.contact.corner_start], 0, before.corner_start);
        device->write(buffers[plan.contact.corner], 0, before.corner);
    }
    else
    {
        std::fill_n(control.begin() + TAUT_CONTACT_LISTED * 4, 4, std::byte{0});
        put_held_pairs(renumbered(before.held, from));
    }
    device->write(buffers[plan.contact.control], 0, control);
    device->write(buffers[plan.contact.lost], 0, before.lost);
}

/// Two words say whether the lists are more than half full, or were too short in a search of the step: then
/// there are longer ones from the next step on.
void World::Impl::grow_contacts()
{
    const PlanContact& contact = plan.contact;
    if (contact.control == kNoBuffer || contact.capacity >= kMostContactPairs)
        return;
    const auto words = device->read<std::uint32_t>(buffers[contact.control], TAUT_CONTACT_WORDS);
    const std::uint32_t missing = words[TAUT_CONTACT_MISSING] - contacts_missing;
    contacts_missing = words[TAUT_CONTACT_MISSING];
    // No search of the step has found more than the list and what it missed.
    const std::uint32_t found =
        std::max(words[TAUT_CONTACT_FOUND], missing > 0 ? contact.capacity + missing : 0);
    if (2 * std::uint64_t(found) > contact.capacity)
        hold_contacts(roomy(found));
}

/// Plans anew with lists of `capacity` pairs; what is listed stays.
void World::Impl::hold_contacts(std::uint32_t capacity)
{
    options.contact_capacity = capacity;
    TornScene same{scene, std::vector<std::uint32_t>(plan.vertex_count), 0};
    for (std::uint32_t v = 0; v < plan.vertex_count; ++v)
        same.origin[v] = v;
    replace_scene(same);
    guessed = false;
}

/// With the guarantee: what a step changes and the next one goes on from. Without it nothing.
std::vector<InputWrite> World::Impl::before_step() const
{
    if (!plan.contact.guarded)
        return {};
    std::vector<std::uint32_t> changed = {plan.position,    plan.low,  plan.velocity, plan.delta,
                                          plan.coasting,    plan.owed, plan.events,   plan.contact.control,
                                          plan.contact.lost};
    changed.insert(changed.end(), plan.kept.begin(), plan.kept.end());
    for (const PlanSolver& solver : plan.solvers)
        changed.push_back(solver.log);
    std::vector<InputWrite> out;
    for (const std::uint32_t buffer : changed)
        if (buffer != kNoBuffer)
            out.push_back({buffer, raw(buffer)});
    return out;
}

/// Plans longer lists where a search of a step has found more than they hold; `missed_before`:
/// TAUT_CONTACT_MISSING when the step began.
bool World::Impl::lengthen_lists(std::uint32_t missed_before)
{
    const auto words = device->read<std::uint32_t>(buffers[plan.contact.control], TAUT_CONTACT_WORDS);
    const std::uint32_t missing = words[TAUT_CONTACT_MISSING] - missed_before;
    if (missing == 0 || plan.contact.capacity >= kMostContactPairs)
        return false;
    hold_contacts(roomy(std::max(words[TAUT_CONTACT_FOUND], plan.contact.capacity + missing)));
    return true;
}

/// With the guarantee a step of which a search has found more than its list holds stood still in part. It is
/// done again with longer lists, from what was before it.
void World::Impl::repeat_step(const std::vector<InputWrite>& before, const std::vector<InputWrite>& inputs)
{
    if (!plan.contact.guarded)
        return;
    while (lengthen_lists(words_of(before, plan.contact.control)[TAUT_CONTACT_MISSING]))
    {
        write_now(before);
        write_now(inputs);
        do_again({clock.at(steps), clock.at(steps + 1)}, program.values());
    }
    pinched_last = refine_step(before, inputs);
    given_up.tangled |= pinched_last;
}

std::vector<std::uint32_t> World::Impl::lost_words() const
{
    return device->read<std::uint32_t>(buffers[plan.contact.lost], plan.contact.guarded
                                                                       ? TAUT_CONTACT_GUARDED_LOST_WORDS
                                                                       : TAUT_CONTACT_LOST_WORDS);
}

ContactCounts World::contacts() const
{
    const PlanContact& contact = impl_->plan.contact;
    if (contact.control == kNoBuffer)
        return {};
    const auto words =
        impl_->device->read<std::uint32_t>(impl_->buffers[contact.control], TAUT_CONTACT_WORDS);
    const std::vector<std::uint32_t> lost = impl_->lost_words();
    ContactCounts out{true,
                      words[TAUT_CONTACT_FOUND],
                      words[TAUT_CONTACT_COMPARED],
                      words[TAUT_CONTACT_SEARCHED],
                      words[TAUT_CONTACT_MISSING],
                      lost[TAUT_CONTACT_CUT],
                      lost[TAUT_CONTACT_CROWDED],
                      contact.capacity,
                      contact.guarded};
    if (!contact.guarded)
        return out;
    out.filtered = lost[TAUT_CONTACT_FILTERED];
    out.pinched = impl_->pinches(lost);
    out.held = lost[TAUT_CONTACT_HELD];
    out.refined = impl_->refined;
    out.untangled = impl_->untangled;
    return out;
}

std::vector<SurfacePair> World::contact_pairs() const
{
    const Plan& plan = impl_->plan;
    if (plan.contact.control == kNoBuffer)
        return {};
    Device& device = *impl_->device;
    const std::uint32_t count =
        device.read<std::uint32_t>(impl_->buffers[plan.contact.control], 1, TAUT_CONTACT_LISTED * 4).front();
    const auto pairs = device.read<layout::ContactPair<float>>(impl_->buffers[plan.contact.pair], count);
    std::vector<SurfacePair> out;
    for (const auto& p : pairs)
    {
        SurfacePair& pair = out.emplace_back();
        pair.vertex = {plan.original[p.a], plan.original[p.b], plan.original[p.c], plan.original[p.d]};
        pair.edges = p.kind == TAUT_CONTACT_EDGES;
    }
    const BufferPtr& side = impl_->buffers[plan.contact.side];
    const BufferPtr& taken = impl_->buffers[plan.contact.taken];
    const double substep = impl_->scene.timestep / impl_->parts / plan.substeps;
    if (plan.precision == Precision::float64)
        add_sides<double>(device, side, taken, substep, out);
    else
        add_sides<float>(device, side, taken, substep, out);
    return out;
}

std::vector<BodyContactForce> World::contact_forces() const
{
    const std::vector<std::uint32_t> body = bodies_of(impl_->scene);
    std::map<std::array<std::uint32_t, 2>, BodyContactForce> found;
    for (const SurfacePair& pair : contact_pairs())
    {
        if (!(pair.push > 0))
            continue;
        const std::uint32_t first = body[pair.vertex[0]], second = body[pair.vertex[pair.edges ? 2 : 1]];
        BodyContactForce& sum = found[{std::min(first, second), std::max(first, second)}];
        sum.a = std::min(first, second);
        sum.b = std::max(first, second);
        ++sum.pairs;
        sum.push += pair.push;
        sum.friction += glm::length(pair.friction);
        if (first != second)
            sum.force += (first < second ? 1.0 : -1.0) * (pair.normal * pair.push + pair.friction);
    }
    std::vector<BodyContactForce> out;
    for (const auto& [bodies, sum] : found)
        out.push_back(sum);
    return out;
}

} // namespace taut
