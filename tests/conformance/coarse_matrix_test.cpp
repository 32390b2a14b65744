#include "taut/kernels/coarse_matrix.hpp"

#include "support/linear_groups.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("coarse_matrix sums the blocks between two aggregates, and their mirror images", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t n = GENERATE(1u, 4u, 17u), groups = GENERATE(1u, 3u), rows = 3 * n;
    Random random(110 + n + groups);
    const std::vector<Real> values = random_reals<Real>(random, 2000);
    std::vector<std::uint32_t> pair, block;
    std::vector<double> sums(rows * rows, 0.0), sizes(rows * rows, 0.0);
    for (std::uint32_t a = 0; a < n; ++a)
        for (std::uint32_t b = a; b < n; ++b)
        {
            pair.insert(pair.end(), {a, b, static_cast<std::uint32_t>(block.size())});
            for (std::uint32_t k = (a + b) % 4; k > 0; --k) // some pairs have nothing between them
                block.push_back(static_cast<std::uint32_t>(random.uniform(0, 1700)));
            for (std::size_t at = pair.back(); at < block.size(); ++at)
                for (std::uint32_t e = 0; e < 9; ++e)
                {
                    const std::uint32_t row = 3 * a + e / 3, column = 3 * b + e % 3;
                    if (row > column)
                        continue; // of a block on the diagonal the upper half counts
                    const auto value = static_cast<double>(values[block[at] + 32 * e]);
                    sums[row * rows + column] += value;
                    sizes[row * rows + column] += std::abs(value);
                }
        }
    pair.insert(pair.end(), {0, 0, static_cast<std::uint32_t>(block.size())});
    block.push_back(0); // a binding has bytes
    CAPTURE(n, groups);

    Case c;
    c.precision = precision_of<Real>();
    const std::uint32_t count = n * (n + 1) / 2, chunk = (count + groups - 1) / groups;
    c.in = {{"pair", bytes_of(pair)},
            {"block", bytes_of(block)},
            {"values", bytes_of(values)},
            {"coarse", bytes_of(std::vector<Real>(rows * rows + 2, Real(-77)))}};
    c.launches = {make_launch(kernels::coarse_matrix::info("", c.precision),
                              kernels::coarse_matrix::Params{count, chunk, rows}, groups + 1)};
    Field& expected = c.expected["coarse"];
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < rows; ++j)
        {
            const std::uint32_t at = std::min(i, j) * rows + std::max(i, j);
            expected.add(i == j ? sums[at] + 0x1p-14 * std::abs(sums[at]) : sums[at], sizes[at]);
        }
    add_unchanged(expected, std::vector<Real>(2, Real(-77)));
    check_on_every_device(c);
}
