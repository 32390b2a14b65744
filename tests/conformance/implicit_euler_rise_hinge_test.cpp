#include "taut/kernels/implicit_euler_rise_hinge.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

using Long3 = glm::vec<3, long double>;

/// A rise of the potential with the size of its terms.
struct Rise
{
    long double value = 0;
    double size = 0;
};

template <typename Real>
Rise hinge(const Net<Real>& net, const layout::BendingConstraint<Real>& c, const std::array<Long3, 4>& step)
{
    const auto v = corners_of(c);
    std::array<glm::dvec3, 4> then{};
    for (std::size_t k = 0; k < 4; ++k)
        then[k] = net.between(v[0], v[k]) + glm::dvec3(step[k] - step[0]);
    const HingeTerms now = hinge_terms(net, c), later = hinge_terms(then);
    if (!now.shaped || !later.shaped)
        return {};
    const double turn = std::remainder(later.angle - now.angle, 2 * 3.14159265358979323846);
    const double off = std::remainder(now.angle - double(c.rest_angle), 2 * 3.14159265358979323846);
    const double factor = net.h() * net.h() / double(c.compliance);
    return {factor * turn * (off + turn / 2), factor * 8 * now.shape * later.shape};
}

} // namespace

TEMPLATE_TEST_CASE("implicit_euler_rise_hinge sums what a step and its halves add to the energy", "", float,
                   double)
{
    using Real = TestType;
    const auto [first, trials] = GENERATE(std::pair(0u, 1u), std::pair(0u, 5u), std::pair(1u, 17u));
    for (const std::uint32_t count : {4u, 63u, 65u, 129u, 300u})
    {
        const Net<Real> net = random_net<Real>(count, 970 + count);
        Dealt dealt;
        dealt.count = static_cast<std::uint32_t>(net.hinges.size());
        dealt.groups = dealt.count > 200 ? 3 : 1;
        dealt.spare = 1;
        CAPTURE(first, trials, count);
        Random random(971 + count);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = net.held[k] != 0 ? Real(0) : x[k] * Real(0.5);
        const std::uint32_t parts = 3, part = 1;
        Case c;
        c.precision = precision_of<Real>();
        c.in = net.buffers();
        c.in["x"] = bytes_of(x);
        c.in["partials"] = bytes_of(std::vector<Real>(trials * parts * dealt.groups, Real(7)));
        const kernels::implicit_euler_rise_hinge::Params params{
            dealt.count, dealt.chunk(), dealt.groups, first, trials, part, parts, net.scale, net.lift};
        c.launches = {make_launch(kernels::implicit_euler_rise_hinge::info("", c.precision), params,
                                  dealt.dispatched())};
        const auto step = [&](std::uint32_t v, long double share) {
            return Long3(x[3 * v], x[3 * v + 1], x[3 * v + 2]) * (share / net.lift);
        };
        Field& field = c.expected["partials"];
        long double share = 1;
        for (std::uint32_t trial = 0; trial < trials; ++trial, share /= 2)
        {
            if (trial < first) // of an earlier pass
            {
                for (std::uint32_t k = 0; k < parts * dealt.groups; ++k)
                    field.add(7, 0);
                continue;
            }
            GroupSums sums(dealt);
            for (std::uint32_t k = 0; k < dealt.count; ++k)
            {
                std::array<Long3, 4> steps;
                for (std::size_t v = 0; v < 4; ++v)
                    steps[v] = step(corners_of(net.hinges[k])[v], share);
                const Rise rise = hinge(net, net.hinges[k], steps);
                const double units = double(net.scale) * double(net.lift) * double(net.lift);
                sums.add(k, double(rise.value) * units, rise.size * units);
            }
            for (std::uint32_t p = 0; p < parts; ++p)
                for (std::uint32_t g = 0; g < dealt.groups && p != part; ++g)
                    field.add(7, 0);
            Field own;
            sums.put(own);
            const auto here = static_cast<long>((trial * parts + part) * dealt.groups);
            field.value.insert(field.value.begin() + here, own.value.begin(), own.value.end());
            field.scale.insert(field.scale.begin() + here, own.scale.begin(), own.scale.end());
        }
        look_on_every_device(c, nullptr);
    }
}
