#include "taut/kernels/coarse_correct.hpp"

#include "support/linear_groups.hpp"

#include <array>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("coarse_correct adds the translation of a vertex' aggregate to what its block gives", "",
                   float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const std::uint32_t aggregates = 7;
    Random random(130 + dealt.count + dealt.groups);
    const std::vector<Real> residual = random_reals<Real>(random, 3 * dealt.count);
    const std::vector<Real> coarse = random_reals<Real>(random, 3 * aggregates);
    std::vector<Real> inverse = random_reals<Real>(random, 6 * dealt.count, 0.5, 2);
    std::vector<std::uint32_t> aggregate;
    for (std::uint32_t v = 0; v < dealt.count; ++v)
    {
        aggregate.push_back(v % 5 == 3 ? 0xffffffffu : v % aggregates);
        if (v % 11 == 4) // a held vertex
            std::fill_n(inverse.begin() + 6 * v, 6, Real(0));
    }
    CAPTURE(dealt.count, dealt.groups);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"residual", bytes_of(residual)},
            {"inverse", bytes_of(inverse)},
            {"aggregate", bytes_of(aggregate)},
            {"coarse", bytes_of(coarse)},
            {"z", bytes_of(std::vector<Real>(3 * dealt.count + 2, Real(-77)))},
            {"partials", bytes_of(std::vector<Real>(dealt.groups + 2, Real(-77)))}};
    c.launches = {make_launch(kernels::coarse_correct::info("", c.precision),
                              kernels::coarse_correct::Params{dealt.count, dealt.chunk(), dealt.groups},
                              dealt.dispatched())};
    GroupSums sums(dealt);
    constexpr std::array<int, 9> kPlace = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    for (std::uint32_t v = 0; v < dealt.count; ++v)
    {
        double product = 0, size = 0;
        for (std::uint32_t i = 0; i < 3; ++i)
        {
            const bool lifted = aggregate[v] < aggregates && inverse[6 * v + kPlace[4 * i]] > 0;
            double z = lifted ? -static_cast<double>(coarse[3 * aggregate[v] + i]) : 0.0, terms = std::abs(z);
            for (std::uint32_t j = 0; j < 3; ++j)
            {
                const double term = static_cast<double>(inverse[6 * v + kPlace[3 * i + j]]) *
                                    static_cast<double>(residual[3 * v + j]);
                z += term;
                terms += std::abs(term);
            }
            c.expected["z"].add(z, terms);
            product += static_cast<double>(residual[3 * v + i]) * z;
            size += std::abs(static_cast<double>(residual[3 * v + i])) * terms;
        }
        sums.add(v, product, size);
    }
    add_unchanged(c.expected["z"], std::vector<Real>(2, Real(-77)));
    sums.put(c.expected["partials"]);
    add_unchanged(c.expected["partials"], std::vector<Real>(2, Real(-77)));
    check_on_every_device(c);
}
