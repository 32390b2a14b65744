#include "taut/kernels/chebyshev.hpp"

#include "support/linear_groups.hpp"

#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
struct Input
{
    std::vector<Real> residual, inverse, z, at, product;
};

template <typename Real>
Input<Real> make_input(const Dealt& dealt)
{
    Random random(900 + dealt.count);
    const std::size_t n = dealt.count + 7; // seven rows behind the count must stay as they are
    Input<Real> in;
    in.residual = random_reals<Real>(random, n);
    in.inverse = random_reals<Real>(random, n, 0.1, 10);
    in.z = random_reals<Real>(random, n);
    in.at = random_reals<Real>(random, n);
    in.product = random_reals<Real>(random, n);
    for (std::size_t i = 0; i < n; ++i)
        if (random.chance(0.1) || i == 64)
        {
            // A held row: the iterates are zero there, and what the product says is of no interest.
            in.inverse[i] = in.z[i] = in.at[i] = 0;
            in.product[i] = std::numeric_limits<Real>::quiet_NaN();
            in.residual[i] = i % 2 == 0 ? std::numeric_limits<Real>::infinity() : Real(0);
        }
    return in;
}

} // namespace

TEMPLATE_TEST_CASE("chebyshev makes the next iterate of the polynomial; the last step sums r.z", "", float,
                   double)
{
    using Real = TestType;
    const std::string variant = GENERATE("first", "only", "second", "second_last", "", "last");
    const bool first = variant == "first" || variant == "only";
    const bool second = variant.starts_with("second");
    const bool last = variant == "only" || variant.ends_with("last");
    const float momentum = 0.37f, gain = 1.9f;
    for (const Dealt& dealt : deals())
    {
        CAPTURE(variant, dealt.count, dealt.groups);
        const Input<Real> in = make_input<Real>(dealt);
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"residual", bytes_of(in.residual)},
                {"inverse", bytes_of(in.inverse)},
                {"z", bytes_of(in.z)},
                {"at", bytes_of(in.at)},
                {"product", bytes_of(in.product)},
                {"partials", bytes_of(std::vector<Real>(dealt.groups, 9))}};
        const kernels::chebyshev::Params params{dealt.count, dealt.chunk(), dealt.groups, momentum, gain};
        c.launches = {
            make_launch(kernels::chebyshev::info(variant, c.precision), params, dealt.dispatched())};
        Field& z = c.expected["z"];
        GroupSums sums(dealt);
        for (std::uint32_t i = 0; i < dealt.count; ++i)
        {
            const double m = double(in.inverse[i]), r = double(in.residual[i]), here = double(in.at[i]);
            if (m == 0)
            {
                z.add(0, 0);
                continue;
            }
            const double before = second ? 0 : double(in.z[i]);
            double next = double(gain) * m * r, size = std::abs(next);
            if (!first)
            {
                const double q = double(in.product[i]);
                next = here + double(momentum) * (here - before) + double(gain) * m * (r - q);
                size = std::abs(here) + double(momentum) * (std::abs(here) + std::abs(before)) +
                       double(gain) * m * (std::abs(r) + std::abs(q));
            }
            z.add(next, size);
            sums.add(i, r * next, std::abs(r) * size);
        }
        add_unchanged(z, in.z, dealt.count);
        if (last)
            sums.put(c.expected["partials"]);
        check_on_every_device(c);
    }
}
