#include "taut/kernels/implicit_update.hpp"

#include "support/implicit_net.hpp"

#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

/// The first trial that does not raise the potential; none where all do, the last where none is a number.
double chosen(const std::vector<double>& rise)
{
    double share = 1;
    bool number = false;
    for (const double r : rise)
    {
        if (std::isfinite(r) && r <= 0)
            return share;
        number = number || std::isfinite(r);
        share /= 2;
    }
    return number ? 0 : 2 * share;
}

} // namespace

TEMPLATE_TEST_CASE("implicit_update takes the whole step without a search", "", float, double)
{
    using Real = TestType;
    for (const Dealt& dealt : deals())
    {
        CAPTURE(dealt.count, dealt.groups);
        const Net<Real> net = random_net<Real>(std::min(dealt.count, 1000u), 980);
        Random random(981 + dealt.count);
        const auto delta = random.vec4s<Real>(dealt.count + 7, 1e-2, 0, 1e-3);
        const auto x = random_reals<Real>(random, 3 * (dealt.count + 7));
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"delta", bytes_of(delta)}, {"x", bytes_of(x)}};
        const kernels::implicit_update::Params params{dealt.count, dealt.chunk(), dealt.groups, 1, 1, 64};
        c.launches = {
            make_launch(kernels::implicit_update::info("", c.precision), params, dealt.dispatched())};
        Field &moved = c.expected["delta"], &left = c.expected["x"];
        for (std::uint32_t v = 0; v < delta.size(); ++v)
            for (std::uint32_t k = 0; k < 4; ++k)
            {
                const bool taken = v < dealt.count && k < 3;
                const double old = double(delta[v][static_cast<int>(k)]);
                const double step = taken ? double(x[3 * v + k]) / 64 : 0;
                moved.add(old + step, taken ? std::abs(old) + std::abs(step) : 0);
            }
        for (std::uint32_t i = 0; i < x.size(); ++i)
            left.add(i < 3 * dealt.count ? 0 : double(x[i]), 0);
        check_on_every_device(c);
    }
}

TEMPLATE_TEST_CASE("implicit_update takes the first trial that does not raise the potential", "", float,
                   double)
{
    using Real = TestType;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const std::vector<double> rise = GENERATE_COPY(
        std::vector<double>{-1, -2, -3}, std::vector<double>{2, -1, -5}, std::vector<double>{2, 1, -1},
        std::vector<double>{0, -1, -1}, std::vector<double>{3, 2, 1}, std::vector<double>{1, 2, 3},
        std::vector<double>{2, 1, 3}, std::vector<double>{kNan, 1, -1}, std::vector<double>{kNan, -1, 1},
        std::vector<double>{2, kNan, 1}, std::vector<double>{kNan, kNan, kNan},
        std::vector<double>{kInf, -kInf, -1}, std::vector<double>{1, kNan, 2},
        std::vector<double>{kInf, kNan});
    const Dealt dealt{300, 3, 1};
    const std::uint32_t parts = 2;
    Random random(985);
    const auto delta = random.vec4s<Real>(dealt.count, 1e-2, 0, 1e-3);
    const auto x = random_reals<Real>(random, 3 * dealt.count);
    std::vector<Real> partials;
    for (const double r : rise)
        for (std::uint32_t k = 0; k < parts * dealt.groups; ++k) // they add up to the rise
            partials.push_back(static_cast<Real>(k == 0 ? r - 5 : 1));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"delta", bytes_of(delta)}, {"x", bytes_of(x)}, {"partials", bytes_of(partials)}};
    const kernels::implicit_update::Params params{
        dealt.count, dealt.chunk(), dealt.groups, static_cast<std::uint32_t>(rise.size()), parts, 64};
    c.launches = {
        make_launch(kernels::implicit_update::info("search", c.precision), params, dealt.dispatched())};
    const double share = chosen(rise);
    CAPTURE(rise, share);
    Field& moved = c.expected["delta"];
    for (std::uint32_t v = 0; v < dealt.count; ++v)
        for (std::uint32_t k = 0; k < 4; ++k)
        {
            const double old = double(delta[v][static_cast<int>(k)]);
            const double step = k < 3 ? double(x[3 * v + k]) * share / 64 : 0;
            moved.add(old + step, k < 3 ? std::abs(old) + std::abs(step) : 0);
        }
    check_on_every_device(c);
}
