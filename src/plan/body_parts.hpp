#pragma once
// Internal to src/plan: the rows of bodies dealt to groups of kernels that form sums of whole bodies.

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

/// Bodies in parts, one group of a dispatch each, in the layout of kernels/shared/body_parts.h.
class BodyParts
{
public:
    /// A body of these rows (none: nothing is added), of which row k takes elements[k] loop trips of an
    /// invocation. `held`: something of the body does not move.
    void add(std::span<const std::uint32_t> rows, std::span<const std::uint32_t> elements, bool held);

    std::uint32_t groups() const { return groups_; }
    std::uint32_t row_count() const { return static_cast<std::uint32_t>(rows_.size()); }
    /// Words of all groups, then all rows.
    std::vector<std::uint32_t> words() const;

private:
    std::vector<std::uint32_t> parts_, rows_;
    std::uint32_t groups_ = 0;
};

} // namespace taut
