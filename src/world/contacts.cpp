// What a world knows of surfaces that meet, and lists of them that grow between steps.

#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact_scene.hpp"
#include "taut/world/world_impl.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

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

template <typename Real>
std::vector<double> rest_gaps(Device& device, const BufferPtr& side, std::uint32_t count)
{
    std::vector<double> out;
    for (const auto& s : device.read<layout::ContactSide<Real>>(side, count))
        out.push_back(static_cast<double>(s.rest_gap));
    return out;
}

} // namespace

ContactLists World::Impl::contact_lists() const
{
    if (plan.contact.control == kNoBuffer)
        return {};
    return {raw(plan.contact.control), raw(plan.contact.lost), raw(plan.contact.pair),
            raw(plan.contact.side)};
}

/// Pairs only where vertices have kept their numbers.
void World::Impl::carry_contacts(const ContactLists& before, bool same_vertices)
{
    if (plan.contact.control == kNoBuffer || before.control.empty())
        return;
    std::vector<std::byte> control = before.control;
    if (same_vertices)
    {
        device->write(buffers[plan.contact.pair], 0, before.pair);
        device->write(buffers[plan.contact.side], 0, before.side);
    }
    else
        std::fill_n(control.begin() + TAUT_CONTACT_LISTED * 4, 4, std::byte{0});
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

ContactCounts World::contacts() const
{
    const PlanContact& contact = impl_->plan.contact;
    if (contact.control == kNoBuffer)
        return {};
    const auto words =
        impl_->device->read<std::uint32_t>(impl_->buffers[contact.control], TAUT_CONTACT_WORDS);
    const auto lost = impl_->device->read<std::uint32_t>(impl_->buffers[contact.lost], 2);
    return {true,
            words[TAUT_CONTACT_FOUND],
            words[TAUT_CONTACT_COMPARED],
            words[TAUT_CONTACT_MISSING],
            lost[TAUT_CONTACT_CUT],
            lost[TAUT_CONTACT_CROWDED],
            contact.capacity};
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
    const BufferPtr& side = impl_->buffers[plan.contact.side];
    const std::vector<double> gaps = plan.precision == Precision::float64
                                         ? rest_gaps<double>(device, side, count)
                                         : rest_gaps<float>(device, side, count);
    std::vector<SurfacePair> out;
    for (std::uint32_t k = 0; k < count; ++k)
        out.push_back({{plan.original[pairs[k].a], plan.original[pairs[k].b], plan.original[pairs[k].c],
                        plan.original[pairs[k].d]},
                       pairs[k].kind == TAUT_CONTACT_EDGES,
                       gaps[k]});
    return out;
}

} // namespace taut
