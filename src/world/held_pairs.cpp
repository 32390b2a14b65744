#include "taut/world/held_pairs.hpp"

#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/world_impl.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

namespace taut {
namespace {

template <typename Real>
std::vector<HeldPair> read_held(Device& device, const BufferPtr& pair, const BufferPtr& side,
                                std::uint32_t count)
{
    const auto pairs = device.read<layout::ContactPair<float>>(pair, count);
    const auto sides = device.read<layout::ContactSide<Real>>(side, count);
    std::vector<HeldPair> out;
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const auto& p = pairs[k];
        const auto& s = sides[k];
        if (s.sticks > 0)
            out.push_back({{p.a, p.b, p.c, p.d},
                           p.kind,
                           {s.slipped_x, s.slipped_y, s.slipped_z},
                           {s.weight_b, s.weight_c, s.weight_d}});
    }
    return out;
}

template <typename Real>
layout::ContactSide<Real> side_of(const HeldPair& pair)
{
    layout::ContactSide<Real> out{};
    const glm::vec<3, Real> slipped(pair.slipped), weight(pair.weight);
    out.slipped_x = slipped.x, out.slipped_y = slipped.y, out.slipped_z = slipped.z;
    out.weight_b = weight.x, out.weight_c = weight.y, out.weight_d = weight.z;
    out.sticks = 1;
    return out;
}

template <typename Real>
std::vector<layout::ContactSide<Real>> sides_of(std::span<const HeldPair> pairs)
{
    std::vector<layout::ContactSide<Real>> out;
    for (const HeldPair& pair : pairs)
        out.push_back(side_of<Real>(pair));
    return out;
}

} // namespace

std::vector<HeldPair> renumbered(std::span<const HeldPair> pairs, std::span<const std::uint32_t> from)
{
    std::map<std::uint32_t, std::optional<std::uint32_t>> becomes;
    for (std::uint32_t v = 0; v < from.size(); ++v)
        if (!becomes.try_emplace(from[v], v).second)
            becomes[from[v]] = std::nullopt;
    std::vector<HeldPair> out;
    for (HeldPair pair : pairs)
    {
        const bool stays = std::ranges::all_of(pair.vertex, [&](std::uint32_t& v) {
            const auto found = becomes.find(v);
            if (found == becomes.end() || !found->second)
                return false;
            v = *found->second;
            return true;
        });
        if (stays)
            out.push_back(pair);
    }
    return out;
}

void check_held(std::span<const HeldPair> pairs, std::uint32_t vertices)
{
    for (const HeldPair& p : pairs)
    {
        const bool known = std::ranges::all_of(p.vertex, [&](std::uint32_t v) { return v < vertices; });
        double sum = 0;
        for (int axis = 0; axis < 3; ++axis)
            sum += p.slipped[axis] + p.weight[axis];
        if (!known || !std::isfinite(sum))
            throw Error(ErrorCode::bad_input, "restore: held[" + std::to_string(&p - pairs.data()) +
                                                  "] has a vertex that is none of the " +
                                                  std::to_string(vertices) +
                                                  " of the plan, or a number that is not finite");
    }
}

std::vector<HeldPair> World::Impl::held_pairs() const
{
    const PlanContact& contact = plan.contact;
    if (contact.control == kNoBuffer)
        return {};
    const auto words = device->read<std::uint32_t>(buffers[contact.control], TAUT_CONTACT_WORDS);
    const std::uint32_t count = std::min(words[TAUT_CONTACT_LISTED], contact.capacity);
    const BufferPtr &pair = buffers[contact.pair], &side = buffers[contact.side];
    return plan.precision == Precision::float64 ? read_held<double>(*device, pair, side, count)
                                                : read_held<float>(*device, pair, side, count);
}

/// As lists of their own, in which the search that comes next finds them (contact_recall.comp).
void World::Impl::put_held_pairs(std::vector<HeldPair> held)
{
    const PlanContact& contact = plan.contact;
    if (contact.control == kNoBuffer)
        return;
    held.resize(std::min<std::size_t>(held.size(), contact.capacity));
    std::ranges::stable_sort(held, {}, [](const HeldPair& p) { return p.vertex[0]; });
    std::vector<std::uint32_t> start(plan.vertex_count + 1, 0), corner;
    std::vector<layout::ContactPair<float>> pairs;
    for (const HeldPair& p : held)
    {
        ++start[p.vertex[0] + 1];
        corner.push_back(4 * static_cast<std::uint32_t>(pairs.size()));
        pairs.push_back({p.vertex[0], p.vertex[1], p.vertex[2], p.vertex[3], p.kind});
    }
    for (std::size_t v = 1; v < start.size(); ++v)
        start[v] += start[v - 1];
    const auto put = [&](std::uint32_t buffer, const auto& values) {
        const auto bytes = std::as_bytes(std::span(values));
        if (!bytes.empty())
            device->write(buffers[buffer], 0, std::vector<std::byte>(bytes.begin(), bytes.end()));
    };
    put(contact.corner_start, start);
    put(contact.corner, corner);
    put(contact.pair, pairs);
    if (plan.precision == Precision::float64)
        put(contact.side, sides_of<double>(held));
    else
        put(contact.side, sides_of<float>(held));
}

} // namespace taut
