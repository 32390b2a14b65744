#include "taut/kernels/coo_carry.hpp"
#include "taut/kernels/spmv_coo.hpp"

#include "support/spmv.hpp"

#include <numeric>

using namespace taut;
using namespace taut::conformance;

namespace {

/// What coo_carry is told of rows (kernels/linear/coo_carry.comp).
template <typename Real>
std::vector<std::uint32_t> carry_table(const Rows<Real>& rows, const Grid& grid, std::uint32_t entries,
                                       std::uint32_t& splits)
{
    std::vector<std::uint32_t> split, empty;
    std::vector<std::uint32_t> split_start, empty_start;
    for (std::uint32_t g = 0; g <= grid.groups; ++g)
    {
        split_start.push_back(static_cast<std::uint32_t>(split.size() / 3));
        empty_start.push_back(static_cast<std::uint32_t>(empty.size()));
        for (std::uint32_t row = g * grid.chunk; row < std::min(rows.count, (g + 1) * grid.chunk); ++row)
        {
            const std::uint32_t first = rows.start[row], last = rows.start[row + 1] - 1;
            if (rows.length(row) == 0)
                empty.push_back(row);
            else if (first / entries != last / entries)
                split.insert(split.end(), {row, first / entries, last / entries});
        }
    }
    splits = static_cast<std::uint32_t>(split.size() / 3);
    std::vector<std::uint32_t> table = split_start;
    for (const auto* part : {&empty_start, &split, &empty})
        table.insert(table.end(), part->begin(), part->end());
    return table;
}

/// `entries` a group.
template <typename Real>
Case coo_case(const Rows<Real>& rows, const std::string& variant, bool low, std::uint32_t groups)
{
    const bool pairs = variant == "residual_pairs";
    const Grid grid = grid_of(rows.count, groups);
    const auto count = static_cast<std::uint32_t>(rows.values.size());
    const std::uint32_t entries = std::max(1u, (count + groups - 1) / groups);
    std::vector<std::uint32_t> slots(count);
    std::iota(slots.begin(), slots.end(), 0u);
    Case c = product_case(rows, variant, low, grid, slots, count);
    std::vector<std::uint32_t> row;
    for (std::uint32_t i = 0; i < rows.count; ++i)
        row.insert(row.end(), rows.length(i), i);
    std::uint32_t splits = 0;
    c.in["table"] = bytes_of(carry_table(rows, grid, entries, splits));
    c.in["row"] = bytes_of(row);
    c.in["column"] = bytes_of(rows.column);
    c.in["carries"] = bytes_of(std::vector<Real>(2 * groups * (pairs ? 2u : 1u), Real(1e6)));
    c.in["sums"] = bytes_of(std::vector<Real>(2 * rows.count, Real(-9)));
    const kernels::spmv_coo::Params product{count, entries, groups, low ? 1u : 0u};
    const kernels::coo_carry::Params carry{rows.count, grid.chunk, groups, splits};
    c.launches = {
        make_launch(kernels::spmv_coo::info(pairs ? variant : "", c.precision), product, groups + 2),
        make_launch(kernels::coo_carry::info(variant, c.precision), carry, groups + 2)};
    return c;
}

template <typename Real>
void check_lengths(const std::vector<std::uint32_t>& lengths, const std::vector<std::uint32_t>& groups,
                   const std::string& variant)
{
    Random random(1000 + lengths.size());
    auto rows = random_rows<Real>(random, lengths);
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t g : groups)
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
            {
                CAPTURE(lengths.size(), g, variant, low);
                check_on_every_device(coo_case(rows, variant, low, g));
            }
}

} // namespace

TEMPLATE_TEST_CASE("spmv_coo and coo_carry multiply, rows without entries too", "[spmv]", float, double)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    Random random(count);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i)
        lengths.push_back(random.chance(0.05) ? random.below(300) : random.below(9));
    lengths[0] = 1;
    check_lengths<TestType>(lengths, {1, 3, (count + 127) / 128}, variant);
}

TEMPLATE_TEST_CASE("spmv_coo adds a row that many groups share", "[spmv]", float, double)
{
    const std::string variant = GENERATE("", "dot", "residual_pairs");
    std::vector<std::uint32_t> lengths(3000, 1);
    lengths[5] = 3000; // the first, a middle and the last row, next to empty ones
    lengths[6] = 0;
    check_lengths<TestType>(lengths, {1, 2, 9, 24}, variant);
    std::vector<std::uint32_t> ends(600, 0);
    ends.front() = 600;
    ends.back() = 600;
    check_lengths<TestType>(ends, {1, 2, 4, 5}, variant);
    std::vector<std::uint32_t> full(40, 40); // rows that end where a lane, a tile or a group ends
    check_lengths<TestType>(full, {1, 2, 5, 40}, variant);
    check_lengths<TestType>(std::vector<std::uint32_t>(128, 7), {1, 4, 128}, variant);
    check_lengths<TestType>(std::vector<std::uint32_t>(256, 7), {1, 2, 16, 256}, variant);
}
