#include "taut/kernels/coarse_restrict.hpp"

#include "support/linear_groups.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("coarse_restrict sums the vertices of each aggregate", "", float, double)
{
    using Real = TestType;
    const std::uint32_t aggregates = GENERATE(1u, 5u, 43u, 128u);
    const std::uint32_t groups = GENERATE(1u, 4u), vertices = 600;
    Random random(70 + aggregates + groups);
    std::vector<std::vector<std::uint32_t>> members(aggregates);
    for (std::uint32_t v = 0; v < vertices; ++v)
        if (const double u = random.uniform(0, 1); u < 0.9) // the others are in none
            members[static_cast<std::uint32_t>(u / 0.9 * aggregates) % aggregates].push_back(v);
    members[0].clear();
    std::vector<std::uint32_t> table;
    std::uint32_t begin = aggregates + 1;
    for (const auto& list : members)
    {
        table.push_back(begin);
        begin += static_cast<std::uint32_t>(list.size());
    }
    table.push_back(begin);
    for (const auto& list : members)
        table.insert(table.end(), list.begin(), list.end());
    const std::vector<Real> residual = random_reals<Real>(random, 3 * vertices);
    CAPTURE(aggregates, groups);

    Case c;
    c.precision = precision_of<Real>();
    const std::uint32_t rows = 3 * aggregates, chunk = (rows + groups - 1) / groups;
    c.in = {{"table", bytes_of(table)},
            {"residual", bytes_of(residual)},
            {"coarse", bytes_of(std::vector<Real>(rows + 2, Real(-77)))}};
    c.launches = {make_launch(kernels::coarse_restrict::info("", c.precision),
                              kernels::coarse_restrict::Params{rows, chunk}, groups + 1)};
    Field& expected = c.expected["coarse"];
    for (std::uint32_t row = 0; row < rows; ++row)
    {
        double sum = 0, size = 0;
        for (const std::uint32_t v : members[row / 3])
        {
            sum += static_cast<double>(residual[3 * v + row % 3]);
            size += std::abs(static_cast<double>(residual[3 * v + row % 3]));
        }
        expected.add(sum, size);
    }
    add_unchanged(expected, std::vector<Real>(2, Real(-77)));
    check_on_every_device(c);
}
