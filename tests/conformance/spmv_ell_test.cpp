#include "taut/kernels/spmv_ell.hpp"

#include "support/spmv.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
Case ell_case(const Rows<Real>& rows, std::string_view variant, bool low, std::uint32_t groups)
{
    const Grid grid = grid_of(rows.count, groups);
    const std::uint32_t stride = rows.count + 5; // any will do
    std::uint32_t width = 0;
    for (std::uint32_t row = 0; row < rows.count; ++row)
        width = std::max(width, rows.length(row));
    std::vector<std::uint32_t> slots, column(std::size_t{stride} * width);
    for (std::uint32_t row = 0; row < rows.count; ++row)
        for (std::uint32_t k = 0; k < width; ++k)
        {
            const bool stored = k < rows.length(row);
            column[k * stride + row] = stored ? rows.column[rows.start[row] + k] : row;
            if (stored)
                slots.push_back(k * stride + row);
        }
    Case c = product_case(rows, variant, low, grid, slots, column.size());
    c.in["column"] = bytes_of(column);
    const kernels::spmv_ell::Params params{rows.count, grid.chunk, groups, stride, width, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_ell::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_ell multiplies rows of different length, padded to one", "[spmv]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    const std::uint64_t seed = 1000 + count;
    CAPTURE(count, variant, seed);
    Random random(seed);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i) // the first is empty unless it is the only one
        lengths.push_back(i == 0 && count > 1 ? 0 : i == 40 ? 60 : 1 + random.below(11));
    auto rows = random_rows<Real>(random, lengths);
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t groups : {1u, 3u, (count + 127) / 128})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(ell_case(rows, variant, low, groups));
}
