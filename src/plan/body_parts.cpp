#include "taut/plan/body_parts.hpp"

#include "taut/plan/builder.hpp"

#include "taut/kernels/shared/body_parts.h"

namespace taut {
namespace {

constexpr std::uint32_t kPartRows = 256; ///< of a group, at most

/// Ends of the groups of a body's rows: a group's lanes may have to loop over all elements of them.
std::vector<std::uint32_t> group_ends(std::span<const std::uint32_t> elements)
{
    std::vector<std::uint32_t> ends;
    std::uint64_t trips = 0;
    std::uint32_t first = 0;
    for (std::uint32_t k = 0; k < elements.size(); ++k)
    {
        if (k > first && (k - first == kPartRows || trips + elements[k] > kMaxLoopTrips))
        {
            ends.push_back(k);
            first = k;
            trips = 0;
        }
        trips += elements[k] + 3;
    }
    if (!elements.empty())
        ends.push_back(static_cast<std::uint32_t>(elements.size()));
    return ends;
}

} // namespace

void BodyParts::add(std::span<const std::uint32_t> rows, std::span<const std::uint32_t> elements, bool held)
{
    const auto begin = row_count();
    const std::vector<std::uint32_t> ends = group_ends(elements);
    const std::uint32_t from = groups_, to = from + static_cast<std::uint32_t>(ends.size());
    for (std::uint32_t k = 0; k < ends.size(); ++k)
        parts_.insert(parts_.end(), {rows.front(), begin + (k == 0 ? 0 : ends[k - 1]), begin + ends[k], from,
                                     to, held ? 1u : 0u});
    static_assert(TAUT_BODY_PART == 6);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    groups_ = to;
}

std::vector<std::uint32_t> BodyParts::words() const
{
    std::vector<std::uint32_t> out = parts_;
    out.insert(out.end(), rows_.begin(), rows_.end());
    return out;
}

} // namespace taut
