#include "taut/kernels/spmv_bcsr3.hpp"

#include "support/spmv.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::conformance;

namespace {

/// Slices of 32 block rows, each as long as its longest: laid out here once more, by the words of the format.
struct Blocks
{
    std::vector<std::uint32_t> slice_start = {0}, column, slots;
};

template <typename Real>
Blocks blocks_of(const Rows<Real>& rows)
{
    const std::uint32_t block_rows = rows.count / 3;
    Blocks out;
    std::vector<std::vector<std::uint32_t>> columns(block_rows);
    for (std::uint32_t row = 0; row < rows.count; ++row)
        for (std::uint32_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
            columns[row / 3].push_back(rows.column[k] / 3);
    for (auto& row : columns)
    {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
    }
    for (std::uint32_t first = 0; first < block_rows; first += 32)
    {
        std::size_t longest = 0;
        for (std::uint32_t r = first; r < std::min(block_rows, first + 32); ++r)
            longest = std::max(longest, columns[r].size());
        for (std::size_t k = 0; k < longest; ++k)
            for (std::uint32_t r = first; r < first + 32; ++r)
                out.column.push_back(r < block_rows && k < columns[r].size() ? columns[r][k] : 0);
        out.slice_start.push_back(out.slice_start.back() + static_cast<std::uint32_t>(longest));
    }
    for (std::uint32_t row = 0; row < rows.count; ++row)
        for (std::uint32_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
        {
            const auto& own = columns[row / 3];
            const auto at = std::lower_bound(own.begin(), own.end(), rows.column[k] / 3) - own.begin();
            const std::uint32_t step = out.slice_start[row / 96] + static_cast<std::uint32_t>(at);
            const std::uint32_t entry = row % 3 * 3 + rows.column[k] % 3;
            out.slots.push_back((step * 9 + entry) * 32 + row / 3 % 32);
        }
    return out;
}

template <typename Real>
Case bcsr3_case(const Rows<Real>& rows, std::string_view variant, bool low, std::uint32_t groups)
{
    const std::uint32_t block_rows = rows.count / 3;
    const std::uint32_t chunk = ((block_rows + groups - 1) / groups + 31) / 32 * 32;
    const Blocks blocks = blocks_of(rows);
    Case c = product_case(rows, variant, low, {rows.count, groups, 3 * chunk}, blocks.slots,
                          std::size_t{blocks.slice_start.back()} * 288);
    c.in["slice_start"] = bytes_of(blocks.slice_start);
    c.in["column"] = bytes_of(blocks.column);
    if (!low) // product_case: may be anything
        c.in["low"] = c.in["values"];
    const kernels::spmv_bcsr3::Params params{block_rows, chunk, groups, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_bcsr3::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_bcsr3 multiplies blocks", "[spmv]", float, double)
{
    using Real = TestType;
    const std::uint32_t block_rows = GENERATE(1u, 31u, 32u, 33u, 63u, 64u, 65u, 128u, 129u, 334u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    const std::uint64_t seed = 1100 + block_rows;
    CAPTURE(block_rows, variant, seed);
    Random random(seed);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < 3 * block_rows; ++i)
        lengths.push_back(random.chance(0.02) ? 100 : random.below(7));
    if (block_rows > 130) // slices without a block
        std::fill(lengths.begin() + 96, lengths.begin() + 3 * 96, 0u);
    auto rows = random_rows<Real>(random, lengths);
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t groups : {1u, 2u, (3 * block_rows + 127) / 128})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(bcsr3_case(rows, variant, low, groups));
}
