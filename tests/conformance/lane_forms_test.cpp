// Constraints whose corners stand in runs, in pairs, or nearly so: eight lanes must give the bits of one
// element at a time, however the indices of a block lie (runtime/cpu/lane_forms.hpp).

#include "taut/kernels/neo_hookean.hpp"
#include "taut/kernels/pbd_hinge.hpp"
#include "taut/kernels/pbd_spring.hpp"
#include "taut/kernels/pbd_volume.hpp"
#include "taut/kernels/strain_limit.hpp"
#include "taut/kernels/xpbd_hinge.hpp"
#include "taut/kernels/xpbd_spring.hpp"
#include "taut/kernels/xpbd_volume.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kCount = 8 * 60 + 5;
constexpr std::uint32_t kRegion = 4 * kCount; // vertices that a corner may have: no two elements share one

struct Pattern
{
    std::string name;
    std::function<std::uint32_t(std::uint32_t element, std::uint32_t corner)> place; ///< below kRegion
};

std::uint32_t in_pairs(std::uint32_t i) { return i / 2 * 4 + i % 2; }

/// Runs in which one element of every block stands elsewhere, in each block another.
std::uint32_t but_for_one(std::uint32_t i) { return i % 8 == i / 8 % 8 ? i + 2 * kCount : i; }

/// What changes every third block: runs, pairs, every second vertex.
std::uint32_t by_turns(std::uint32_t i)
{
    const std::uint32_t kind = i / 24 % 3, k = i % 24;
    return i / 24 * 96 + (kind == 0 ? k : kind == 1 ? in_pairs(k) : 2 * k);
}

std::vector<Pattern> patterns(Random& random)
{
    const std::vector<std::uint32_t> order = random.shuffled(kRegion);
    return {
        {"runs", [](auto i, auto) { return i; }},
        {"pairs", [](auto i, auto) { return in_pairs(i); }},
        {"every second", [](auto i, auto) { return 2 * i; }},
        {"runs with gaps", [](auto i, auto) { return i + i / 13; }},
        {"backwards", [](auto i, auto) { return kRegion - 1 - i; }},
        {"neighbours change places", [](auto i, auto) { return i ^ 1u; }},
        {"pairs change places", [](auto i, auto) { return in_pairs(i ^ 2u); }},
        {"all but one in a run", [](auto i, auto) { return but_for_one(i); }},
        {"first corner in runs", [](auto i, auto corner) { return corner == 0 ? i : in_pairs(i); }},
        {"last corner anywhere", [](auto i, auto corner) { return corner == 1 ? 3 * i : i; }},
        {"by turns", [](auto i, auto) { return by_turns(i); }},
        {"anywhere", [order](auto i, auto) { return order[i]; }},
    };
}

/// What a kernel binds, by name, each at a place of its own.
class Memory
{
public:
    Memory(const KernelInfo& kernel, std::uint32_t corners, const Pattern& pattern, Random& random)
    {
        for (const BindingInfo& binding : kernel.bindings)
        {
            const bool of_vertices = binding.name == "position" || binding.name == "delta";
            const std::size_t records = std::size_t{corners} * (of_vertices ? kRegion : kCount);
            const std::size_t words = binding.stride / 4 * records;
            std::vector<float>& values = buffers_.emplace_back(words);
            const bool counts = binding.access == Access::count;
            for (float& value : values)
                value = counts ? 0 : random.uniform<float>(0.1, binding.name == "delta" ? 0.2 : 2);
            if (binding.name == "constraint")
                set_corners(values, binding.stride / 4, corners, pattern);
        }
    }

    std::vector<void*> pointers()
    {
        std::vector<void*> out;
        for (std::vector<float>& values : buffers_)
            out.push_back(values.data());
        return out;
    }

    bool same_as(const Memory& other) const
    {
        for (std::size_t i = 0; i < buffers_.size(); ++i)
            if (std::memcmp(buffers_[i].data(), other.buffers_[i].data(), 4 * buffers_[i].size()) != 0)
                return false;
        return true;
    }

private:
    static void set_corners(std::vector<float>& values, std::size_t words, std::uint32_t corners,
                            const Pattern& pattern)
    {
        for (std::uint32_t i = 0; i < kCount; ++i)
            for (std::uint32_t corner = 0; corner < corners; ++corner)
            {
                const std::uint32_t vertex = corner * kRegion + pattern.place(i, corner);
                std::memcpy(&values[i * words + corner], &vertex, 4);
            }
    }

    std::vector<std::vector<float>> buffers_;
};

std::vector<std::byte> params_of(const KernelInfo& kernel, std::uint32_t report)
{
    std::vector<std::byte> out(kernel.param_bytes);
    for (const ParamInfo& param : kernel.params)
    {
        const float half = 0.5f;
        std::uint32_t value = param.name == "count" ? kCount : param.name == "report" ? report : 0;
        if (param.type == "float")
            std::memcpy(&value, &half, 4);
        std::memcpy(out.data() + param.offset, &value, 4);
    }
    return out;
}

/// All elements, `at_once` a call; ranges of seven make no block.
void run(const KernelInfo& kernel, Memory& memory, std::uint32_t report, std::uint32_t at_once)
{
    const std::vector<std::byte> params = params_of(kernel, report);
    const std::vector<void*> pointers = memory.pointers();
    for (std::uint32_t begin = 0; begin < kCount; begin += at_once)
        kernel.native(params.data(), pointers.data(), begin, std::min(begin + at_once, kCount));
}

void check(std::span<const KernelInfo> kernels, std::uint32_t corners)
{
    Random random(700 + corners);
    for (const KernelInfo& kernel : kernels)
    {
        if (kernel.group_kernel || kernel.precision != Precision::float32)
            continue;
        for (const Pattern& pattern : patterns(random))
            for (const std::uint32_t report : {0u, 1u})
            {
                CAPTURE(kernel.name, kernel.variant, pattern.name, report);
                const Memory before(kernel, corners, pattern, random);
                Memory single = before, lanes = before;
                run(kernel, single, report, 7);
                run(kernel, lanes, report, kCount);
                CHECK_FALSE(single.same_as(before));
                CHECK(lanes.same_as(single));
            }
    }
}

} // namespace

TEST_CASE("elements in runs and pairs come out of eight lanes as they do one at a time")
{
    check(kernels::xpbd_spring::all(), 2);
    check(kernels::pbd_spring::all(), 2);
    check(kernels::strain_limit::all(), 2);
    check(kernels::xpbd_hinge::all(), 4);
    check(kernels::pbd_hinge::all(), 4);
    check(kernels::xpbd_volume::all(), 4);
    check(kernels::pbd_volume::all(), 4);
    check(kernels::neo_hookean::all(), 4);
}
