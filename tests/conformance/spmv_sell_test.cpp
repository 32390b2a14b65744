#include "taut/kernels/spmv_sell.hpp"

#include "support/spmv.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// The kernel takes rows in any order, so the test shuffles them instead of sorting.
template <typename Real>
Case sell_case(const Rows<Real>& rows, Random& random, std::string_view variant, bool low,
               std::uint32_t groups)
{
    const Grid grid = grid_of(rows.count, groups);
    const std::vector<std::uint32_t> order = random.shuffled(rows.count);
    std::vector<std::uint32_t> slice_start = {0}, column, slots(rows.values.size());
    for (std::uint32_t base = 0; base < rows.count; base += 32)
    {
        const std::uint32_t end = std::min(base + 32, rows.count);
        std::uint32_t width = 0;
        for (std::uint32_t place = base; place < end; ++place)
            width = std::max(width, rows.length(order[place]));
        column.resize(column.size() + std::size_t{32} * width);
        for (std::uint32_t place = base; place < end; ++place)
            for (std::uint32_t k = 0; k < width; ++k)
            {
                const std::uint32_t row = order[place], at = slice_start.back() + k * 32 + place - base;
                const bool stored = k < rows.length(row);
                column[at] = stored ? rows.column[rows.start[row] + k] : row;
                if (stored)
                    slots[rows.start[row] + k] = at;
            }
        slice_start.push_back(static_cast<std::uint32_t>(column.size()));
    }
    Case c = product_case(rows, variant, low, grid, slots, column.size(), {}, order);
    c.in["slice_start"] = bytes_of(slice_start);
    c.in["order"] = bytes_of(order);
    c.in["column"] = bytes_of(column);
    const kernels::spmv_sell::Params params{rows.count, grid.chunk, groups, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_sell::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_sell multiplies rows in slices and writes each where it belongs", "[spmv]", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 31u, 32u, 33u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    const std::uint64_t seed = 1100 + count;
    CAPTURE(count, variant, seed);
    Random random(seed);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i)
        lengths.push_back(random.chance(0.02) ? 200 : random.below(12));
    if (count > 400) // whole slices without an entry
        std::fill(lengths.begin() + 200, lengths.begin() + 300, 0u);
    auto rows = random_rows<Real>(random, lengths);
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t groups : {1u, 3u, (count + 127) / 128})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(sell_case(rows, random, variant, low, groups));
}
