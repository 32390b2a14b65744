#include "taut/kernels/implicit_guess.hpp"

#include "support/linear_groups.hpp"

#include <limits>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_guess scales a vector to the least of a quadratic along it", "", float, double)
{
    using Real = TestType;
    const std::string kind = GENERATE("plain", "flat", "negative", "not finite");
    for (const Dealt& dealt : deals())
    {
        CAPTURE(kind, dealt.count, dealt.groups);
        Random random(940 + dealt.count);
        const auto x = random_reals<Real>(random, dealt.count + 7);
        const auto products = random_reals<Real>(random, dealt.groups, 0.5, 2);
        auto curvatures = random_reals<Real>(random, dealt.groups, 0.5, 2);
        if (kind == "flat")
            curvatures.assign(dealt.groups, Real(0));
        if (kind == "negative")
            curvatures.assign(dealt.groups, Real(-1));
        if (kind == "not finite")
            curvatures.back() = std::numeric_limits<Real>::quiet_NaN();
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"x", bytes_of(x)}, {"products", bytes_of(products)}, {"curvatures", bytes_of(curvatures)}};
        c.launches = {make_launch(kernels::implicit_guess::info("", c.precision),
                                  kernels::implicit_guess::Params{dealt.count, dealt.chunk(), dealt.groups},
                                  dealt.dispatched())};
        double slope = 0, bend = 0;
        for (std::uint32_t g = 0; g < dealt.groups; ++g)
        {
            slope += double(products[g]);
            bend += double(curvatures[g]);
        }
        const double share = kind == "plain" ? slope / bend : 0;
        Field& field = c.expected["x"];
        for (std::uint32_t i = 0; i < dealt.count; ++i)
            field.add(double(x[i]) * share, std::abs(double(x[i])) * share);
        add_unchanged(field, x, dealt.count);
        look_on_every_device(c, nullptr);
    }
}
