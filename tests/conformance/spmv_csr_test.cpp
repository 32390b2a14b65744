#include "taut/kernels/spmv_csr.hpp"

#include "support/spmv.hpp"

#include <numeric>

using namespace taut;
using namespace taut::conformance;

namespace {

/// Mostly few entries, now and then hundreds: more than a lane's share and more than one piece of shared
/// memory.
std::vector<std::uint32_t> lengths_of(Random& random, std::uint32_t count)
{
    std::vector<std::uint32_t> lengths;
    for (std::uint32_t i = 0; i < count; ++i)
        lengths.push_back(random.chance(0.05) ? 100 + random.below(400) : random.below(12));
    lengths[0] = 3;
    if (count > 300) // rows of no entries belong to spmv_csr_long: a whole window of them too
        std::fill(lengths.begin() + 128, lengths.begin() + 258, 0u);
    return lengths;
}

template <typename Real>
Case csr_case(const Rows<Real>& rows, std::string_view variant, bool low, std::uint32_t groups)
{
    const Grid grid = grid_of(rows.count, groups);
    std::vector<std::uint32_t> slots(rows.values.size());
    std::iota(slots.begin(), slots.end(), 0u);
    Case c = product_case(rows, variant, low, grid, slots, slots.size(),
                          [&](std::uint32_t row) { return rows.length(row) > 0; });
    c.in["row_start"] = bytes_of(rows.start);
    c.in["column"] = bytes_of(rows.column);
    const kernels::spmv_csr::Params params{rows.count, grid.chunk, groups, low ? 1u : 0u};
    c.launches = {make_launch(kernels::spmv_csr::info(variant, c.precision), params, groups + 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("spmv_csr multiplies short rows and leaves rows without entries", "[spmv]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    const std::string way = GENERATE("", "stream");
    const std::uint64_t seed = 800 + count;
    CAPTURE(count, variant, way, seed);
    Random random(seed);
    auto rows = random_rows<Real>(random, lengths_of(random, count));
    plant_right_hand_side(rows, random, 1e-5);
    const std::string name = way + (way.empty() || variant.empty() ? "" : "_") + variant;
    for (const std::uint32_t groups : {1u, 3u, (count + 127) / 128})
        for (const bool low : {false, true})
            if (!low || variant == "residual_pairs")
                check_on_every_device(csr_case(rows, name, low, groups));
}

TEMPLATE_TEST_CASE("both ways of spmv_csr give the same bits", "[spmv]", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "dot", "residual", "residual_pairs");
    Random random(850);
    auto rows = random_rows<Real>(random, lengths_of(random, 700));
    plant_right_hand_side(rows, random, 1e-5);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()) || !bitwise_equal_expected(device->info()))
            continue;
        CAPTURE(selector, variant);
        const Case row = csr_case(rows, variant, true, 4);
        const Case stream = csr_case(rows, variant.empty() ? "stream" : "stream_" + variant, true, 4);
        CHECK(differing_buffers(run(*device, row.launches, row.in),
                                run(*device, stream.launches, stream.in)) == "");
    }
}
