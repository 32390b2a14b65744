#include "taut/kernels/coo_carry.hpp"

#include "support/expect.hpp"

using namespace taut;
using namespace taut::conformance;

// With spmv_coo before it, on random rows: spmv_coo_test.cpp.

TEMPLATE_TEST_CASE("coo_carry adds carries in the order of groups and clears empty rows", "", float, double)
{
    using Real = TestType;
    constexpr std::uint32_t count = 300, chunk = 128, groups = 3, splits = 2;
    // Row 127 is made by groups 0 to 2, row 130 by 1 and 2; rows 0, 128 and 299 are empty.
    const std::vector<std::uint32_t> table = {0, 1, 2, 2, 0, 1, 2, 3, 127, 0, 2, 130, 1, 2, 0, 128, 299};
    std::vector<Real> y(count, Real(2)), x(count, Real(1)), b(count, Real(5));
    const Real eps = std::numeric_limits<Real>::epsilon();
    // In this order the small one is lost: 1 + eps / 2 = 1, then - 1.
    const std::vector<Real> carries = {Real(77), eps / 2, Real(-1), Real(1), Real(8), Real(77)};
    const std::string variant = GENERATE("", "dot", "residual");
    CAPTURE(variant);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(table)}, {"carries", bytes_of(carries)},
            {"y", bytes_of(y)},         {"x", bytes_of(x)},
            {"b", bytes_of(b)},         {"partials", bytes_of(std::vector<Real>(groups, Real(-3)))}};
    const kernels::coo_carry::Params params{count, chunk, groups, splits};
    c.launches = {make_launch(kernels::coo_carry::info(variant, c.precision), params, groups + 1)};
    double sums[groups] = {};
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const bool empty = i == 0 || i == 128 || i == 299;
        const double product = i == 127 ? 0 : (i == 130 ? 7 : (empty ? 0 : 2));
        sums[i / chunk] += product;
        c.expected["y"].add(variant == "residual" ? 5 - product : product, 0);
    }
    if (variant == "dot") // whole numbers: exact
        for (const double sum : sums)
            c.expected["partials"].add(sum, 0);
    check_on_every_device(c);
}
