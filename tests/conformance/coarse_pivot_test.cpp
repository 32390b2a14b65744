#include "taut/kernels/coarse_pivot.hpp"

#include "support/linear_groups.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// Symmetric, with ones and more on the diagonal.
template <typename Real>
std::vector<Real> symmetric(Random& random, std::uint32_t n)
{
    std::vector<Real> a(std::size_t{n} * n);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j <= i; ++j)
            a[i * n + j] = a[j * n + i] = random.uniform<Real>(i == j ? 1 : -0.5, i == j ? 2 : 0.5);
    return a;
}

} // namespace

TEMPLATE_TEST_CASE("coarse_pivot sweeps one pivot", "", float, double)
{
    using Real = TestType;
    const std::uint32_t n = GENERATE(1u, 6u, 129u), groups = GENERATE(1u, 4u);
    const Real lead = GENERATE(Real(1.5), Real(0), Real(-1)); // a pivot that is not positive is left out
    Random random(90 + n + groups);
    std::vector<Real> before = symmetric<Real>(random, n);
    const std::uint32_t k = n / 2;
    before[k * n + k] = lead;
    CAPTURE(n, groups, lead);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"before", bytes_of(before)},
            {"after", bytes_of(std::vector<Real>(before.size() + 2, Real(-77)))}};
    const std::uint32_t chunk = (n + groups - 1) / groups;
    c.launches = {make_launch(kernels::coarse_pivot::info("", c.precision),
                              kernels::coarse_pivot::Params{n, chunk, k}, groups + 1)};
    Field& expected = c.expected["after"];
    const double inverse = lead > 0 ? 1 / static_cast<double>(lead) : 0;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
        {
            const double own = before[i * n + j], along = before[i * n + k], other = before[k * n + j];
            const double share = along * other * inverse;
            if (i == k && j == k)
                expected.add(-inverse, inverse);
            else if (i == k || j == k)
                expected.add((i == k ? other : along) * inverse,
                             std::abs((i == k ? other : along) * inverse));
            else
                expected.add(own - share, std::abs(own) + std::abs(share));
        }
    add_unchanged(expected, std::vector<Real>(2, Real(-77)));
    check_on_every_device(c);
}
