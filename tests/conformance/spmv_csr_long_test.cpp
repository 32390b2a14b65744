#include "taut/kernels/spmv_csr_long.hpp"

#include "support/spmv.hpp"

#include <numeric>

using namespace taut;
using namespace taut::conformance;

namespace {

/// Around one entry a lane, several, and none.
std::vector<std::uint32_t> lengths_of(Random& random, std::uint32_t count)
{
    static constexpr std::uint32_t kLengths[] = {0, 1, 2, 127, 128, 129, 255, 256, 257, 1000};
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i)
        lengths.push_back(count <= 65 ? random.below(count + 1) : kLengths[random.below(10)]);
    return lengths;
}

/// Every third row is in the list; the first and the last of the list are left to another dispatch.
template <typename Real>
Case long_case(const Rows<Real>& rows, std::string_view variant, bool low, std::uint32_t groups)
{
    std::vector<std::uint32_t> list, slots(rows.values.size());
    for (std::uint32_t row = 0; row < rows.count; row += 3)
        list.insert(list.end(), {row, rows.start[row], rows.start[row + 1]});
    const auto listed = static_cast<std::uint32_t>(list.size() / 3);
    const std::uint32_t begin = listed > 2 ? 1 : 0, end = listed > 2 ? listed - 1 : listed;
    std::iota(slots.begin(), slots.end(), 0u);
    Case c =
        product_case(rows, variant, low, grid_of(rows.count, groups), slots, slots.size(),
                     [&](std::uint32_t row) { return row % 3 == 0 && row / 3 >= begin && row / 3 < end; });
    c.in["long_rows"] = bytes_of(list);
    c.in["column"] = bytes_of(rows.column);
    const kernels::spmv_csr_long::Params params{begin, end, groups, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_csr_long::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_csr_long multiplies the rows of its list and no others", "[spmv]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::string variant = GENERATE("", "residual", "residual_pairs");
    const std::uint64_t seed = 900 + count;
    CAPTURE(count, variant, seed);
    Random random(seed);
    auto rows = random_rows<Real>(random, lengths_of(random, count));
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::uint32_t groups : {1u, 3u, 8u})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(long_case(rows, variant, low, groups));
}
