#include "taut/runtime/base/dispatch.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace taut {
namespace {

// ---------------------------------------------------------------- deriving barriers

/// Bytes touched since the last barrier, as disjoint ranges. Ranges that touch are joined, so that
/// many readers of one buffer stay one entry and 50,000 dispatches without a barrier stay fast.
class ByteSet
{
public:
    bool overlaps(std::uint64_t begin, std::uint64_t end) const
    {
        const auto next = end_of_.lower_bound(end); // first range that begins at or after `end`
        return next != end_of_.begin() && std::prev(next)->second > begin;
    }

    void insert(std::uint64_t begin, std::uint64_t end)
    {
        auto at = end_of_.upper_bound(begin);
        if (at != end_of_.begin() && std::prev(at)->second >= begin)
            --at;
        while (at != end_of_.end() && at->first <= end)
        {
            begin = std::min(begin, at->first);
            end = std::max(end, at->second);
            at = end_of_.erase(at);
        }
        end_of_.emplace_hint(at, begin, end);
    }

    void clear() { end_of_.clear(); }

private:
    std::map<std::uint64_t, std::uint64_t> end_of_; ///< begin of a range -> its end
};

/// What happened to one buffer since the last barrier.
struct BufferHistory
{
    std::size_t epoch = 0; ///< barriers so far when this was last touched; older means empty
    ByteSet read, written, counted;
};

class History
{
public:
    void barrier() { ++epoch_; }

    bool conflicts(const BufferRange& range, Access access)
    {
        const BufferHistory& past = of(range.buffer);
        const std::uint64_t end = range.offset + range.bytes;
        if (past.written.overlaps(range.offset, end))
            return true;
        if (access != Access::count && past.counted.overlaps(range.offset, end))
            return true;
        return writes(access) && past.read.overlaps(range.offset, end);
    }

    void add(const BufferRange& range, Access access)
    {
        if (range.bytes == 0)
            return;
        BufferHistory& past = of(range.buffer);
        ByteSet& set = access == Access::count ? past.counted : writes(access) ? past.written : past.read;
        set.insert(range.offset, range.offset + range.bytes);
    }

private:
    BufferHistory& of(std::uint32_t buffer)
    {
        BufferHistory& past = buffers_[buffer];
        if (past.epoch != epoch_)
        {
            past.read.clear();
            past.written.clear();
            past.counted.clear();
            past.epoch = epoch_;
        }
        return past;
    }

    std::size_t epoch_ = 0;
    std::unordered_map<std::uint32_t, BufferHistory> buffers_;
};

/// Calls visit(range, access) for every binding, then for the indirect group counts.
template <typename Visit>
void for_each_access(const Dispatch& dispatch, Visit&& visit)
{
    assert(dispatch.kernel && dispatch.bindings.size() == dispatch.kernel->bindings.size());
    for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
        visit(dispatch.bindings[i], dispatch.kernel->bindings[i].access);
    if (dispatch.indirect.buffer != kNoBuffer)
        visit(dispatch.indirect, Access::read);
}

} // namespace

std::vector<bool> derive_barriers(std::span<const Dispatch> dispatches)
{
    std::vector<bool> barrier_before(dispatches.size(), false);
    History history;
    for (std::size_t i = 0; i < dispatches.size(); ++i)
    {
        bool conflict = false;
        for_each_access(dispatches[i], [&](const BufferRange& range, Access access) {
            conflict = conflict || (range.bytes > 0 && history.conflicts(range, access));
        });
        if (conflict)
        {
            barrier_before[i] = true;
            history.barrier();
        }
        // Only now: bindings of one dispatch do not conflict with each other.
        for_each_access(dispatches[i],
                        [&](const BufferRange& range, Access access) { history.add(range, access); });
    }
    return barrier_before;
}

// ---------------------------------------------------------------- judging them
// Shares nothing with the code above but the data: every pair is compared, by the plain definition.

namespace {

struct Touch
{
    std::string_view binding;
    BufferRange range;
    bool reads = false;
    bool writes = false;
    bool counts = false;
};

std::vector<Touch> touches(const Dispatch& dispatch)
{
    std::vector<Touch> out;
    for (std::size_t i = 0; i < dispatch.bindings.size(); ++i)
    {
        const BindingInfo& binding = dispatch.kernel->bindings[i];
        const bool reads = binding.access == Access::read || binding.access == Access::update;
        const bool writes = binding.access == Access::write || binding.access == Access::update;
        out.push_back({binding.name, dispatch.bindings[i], reads, writes, binding.access == Access::count});
    }
    if (dispatch.indirect.buffer != kNoBuffer)
        out.push_back({"its group counts", dispatch.indirect, true, false, false});
    return out;
}

bool conflict(const Touch& a, const Touch& b)
{
    if (a.range.buffer != b.range.buffer || a.range.bytes == 0 || b.range.bytes == 0)
        return false;
    const bool apart =
        a.range.offset + a.range.bytes <= b.range.offset || b.range.offset + b.range.bytes <= a.range.offset;
    const bool both_read = a.reads && !a.writes && b.reads && !b.writes;
    const bool both_count = a.counts && b.counts;
    return !apart && !both_read && !both_count;
}

std::string describe(std::size_t index, const Dispatch& dispatch, const Touch& touch)
{
    const char* verb = touch.counts                  ? "counts in"
                       : touch.reads && touch.writes ? "updates"
                       : touch.writes                ? "writes"
                                                     : "reads";
    const std::uint64_t end = touch.range.offset + touch.range.bytes;
    return "dispatch " + std::to_string(index) + " (" + std::string(dispatch.kernel->name) + ") " + verb +
           " " + std::string(touch.binding) + " [bytes " + std::to_string(touch.range.offset) + " to " +
           std::to_string(end) + "]";
}

Hazard make_hazard(std::span<const Dispatch> list, std::size_t i, const Touch& a, std::size_t j,
                   const Touch& b)
{
    const std::uint64_t begin = std::max(a.range.offset, b.range.offset);
    const std::uint64_t end = std::min(a.range.offset + a.range.bytes, b.range.offset + b.range.bytes);
    return {i, j, a.range.buffer,
            describe(i, list[i], a) + " and " + describe(j, list[j], b) + " of buffer " +
                std::to_string(a.range.buffer) + " with no barrier between them, and bytes " +
                std::to_string(begin) + " to " + std::to_string(end) + " are shared"};
}

} // namespace

std::vector<Hazard> find_hazards(std::span<const Dispatch> dispatches,
                                 const std::vector<bool>& barrier_before)
{
    assert(barrier_before.size() == dispatches.size());
    std::vector<Hazard> hazards;
    std::vector<std::vector<Touch>> since_barrier; // of dispatches start..j-1
    std::size_t start = 0;
    for (std::size_t j = 0; j < dispatches.size(); ++j)
    {
        if (barrier_before[j])
        {
            since_barrier.clear();
            start = j;
        }
        std::vector<Touch> mine = touches(dispatches[j]);
        for (std::size_t i = start; i < j; ++i)
            for (const Touch& a : since_barrier[i - start])
                for (const Touch& b : mine)
                    if (conflict(a, b))
                        hazards.push_back(make_hazard(dispatches, i, a, j, b));
        since_barrier.push_back(std::move(mine));
    }
    return hazards;
}

void check_no_hazard(std::span<const Dispatch> dispatches, const std::vector<bool>& barrier_before)
{
    if (const std::vector<Hazard> hazards = find_hazards(dispatches, barrier_before); !hazards.empty())
        throw std::logic_error("a barrier is missing: " + hazards.front().text);
}

} // namespace taut
