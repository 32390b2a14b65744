#include "taut/kernels/spmv_dense.hpp"

#include "support/spmv.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
Case dense_case(const Rows<Real>& rows, std::string_view variant, bool low, std::uint32_t groups)
{
    const Grid grid = grid_of(rows.count, groups);
    std::vector<std::uint32_t> slots;
    for (std::uint32_t row = 0; row < rows.count; ++row)
        for (std::uint32_t k = rows.start[row]; k < rows.start[row + 1]; ++k)
            slots.push_back(row * rows.count + rows.column[k]);
    Case c = product_case(rows, variant, low, grid, slots, std::size_t{rows.count} * rows.count);
    const kernels::spmv_dense::Params params{rows.count, grid.chunk, groups, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_dense::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_dense multiplies every entry", "[spmv]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 300u, 1000u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    const std::uint64_t seed = 900 + count;
    CAPTURE(count, variant, seed);
    Random random(seed);
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i) // some rows full, some empty
        lengths.push_back(random.chance(0.1) ? count : random.below(20));
    auto rows = random_rows<Real>(random, lengths);
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t groups : {1u, (count + 127) / 128})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(dense_case(rows, variant, low, groups));
}
