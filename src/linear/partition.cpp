// Based on: George, Liu. Computer Solution of Large Sparse Positive Definite Systems. 1981, 4.3 (level
//   structures from a vertex far from the others) and 8.3 (bisection by them).
// Departures: halves are cut where the count says, inside a level too.

#include "taut/linear/partition.hpp"

#include <algorithm>
#include <span>

namespace taut::linear {
namespace {

class Bisection
{
public:
    Bisection(const SparseMatrix& pattern, const std::vector<bool>& left_out)
        : pattern_(pattern),
          part_(left_out.size(), kNoPart),
          range_(left_out.size(), kNobody),
          seen_(left_out.size(), 0)
    {
        for (std::uint32_t v = 0; v < left_out.size(); ++v)
            if (!left_out[v])
                vertices_.push_back(v);
    }

    std::vector<std::uint32_t> cut(std::uint32_t parts)
    {
        const auto count = static_cast<std::uint32_t>(vertices_.size());
        if (count > 0)
            halve(vertices_, 0, std::min(std::max(parts, 1u), count));
        return std::move(part_);
    }

private:
    static constexpr std::uint32_t kNobody = 0xffffffffu;

    /// Gives `vertices` the numbers first .. first + parts - 1; orders them on the way.
    void halve(std::span<std::uint32_t> vertices, std::uint32_t first, std::uint32_t parts)
    {
        if (parts == 1)
        {
            for (const std::uint32_t v : vertices)
                part_[v] = first;
            return;
        }
        const std::uint32_t range = next_range_++;
        for (const std::uint32_t v : vertices)
            range_[v] = range;
        const std::vector<std::uint32_t> order = by_levels(vertices, range);
        std::copy(order.begin(), order.end(), vertices.begin());
        const std::uint32_t left = parts / 2;
        const std::size_t size = vertices.size() * left / parts;
        halve(vertices.first(size), first, left);
        halve(vertices.subspan(size), first + left, parts - left);
    }

    /// Component after component, each from a vertex at its end.
    std::vector<std::uint32_t> by_levels(std::span<const std::uint32_t> vertices, std::uint32_t range)
    {
        std::vector<std::uint32_t> order, probe;
        order.reserve(vertices.size());
        const std::uint32_t probed = ++stamp_;
        const std::uint32_t taken = ++stamp_;
        for (const std::uint32_t v : vertices)
        {
            if (seen_[v] == taken)
                continue;
            probe.clear();
            visit(v, range, probed, probe);
            visit(probe.back(), range, taken, order);
        }
        return order;
    }

    /// Appends what hangs together with `start` in `range`, level by level.
    void visit(std::uint32_t start, std::uint32_t range, std::uint32_t stamp,
               std::vector<std::uint32_t>& order)
    {
        std::size_t next = order.size();
        order.push_back(start);
        seen_[start] = stamp;
        for (; next < order.size(); ++next)
        {
            const std::uint32_t row = 3 * order[next];
            for (std::uint32_t k = pattern_.row_start[row]; k < pattern_.row_start[row + 1]; ++k)
            {
                const std::uint32_t v = pattern_.column[k] / 3;
                if (range_[v] != range || seen_[v] == stamp)
                    continue;
                seen_[v] = stamp;
                order.push_back(v);
            }
        }
    }

    const SparseMatrix& pattern_;
    std::vector<std::uint32_t> part_, range_, seen_, vertices_;
    std::uint32_t next_range_ = 0, stamp_ = 0;
};

} // namespace

std::vector<std::uint32_t> partition(const SparseMatrix& pattern, std::uint32_t parts,
                                     const std::vector<bool>& left_out)
{
    return Bisection(pattern, left_out).cut(parts);
}

} // namespace taut::linear
