#include "taut/kernels/implicit_trial.hpp"

#include "support/solid_net.hpp"

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

/// 1/2 |displacement - guess|_M^2 after less before.
template <typename Real>
Rise inertia(const Net<Real>& net, std::uint32_t v, const Long3& step)
{
    const Long3 lag = Long3(net.delta[v]) - Long3(net.predicted[v]), after = lag + step;
    const long double mass = net.mass(v);
    return {mass / 2 * (glm::dot(after, after) - glm::dot(lag, lag)),
            net.mass(v) *
                double(glm::length(step) * (glm::length(Long3(net.delta[v])) +
                                            glm::length(Long3(net.predicted[v])) + glm::length(step)))};
}

template <typename Real>
Rise spring(const Net<Real>& net, const layout::Spring<Real>& s, const Long3& step)
{
    const auto moved = [&](std::uint32_t v) { return Long3(net.delta[v]) - Long3(net.low[v]); };
    const Long3 d = (Long3(net.position[s.a]) - Long3(net.position[s.b])) +
                    (Long3(net.delta[s.a]) - Long3(net.delta[s.b]));
    const long double rest = s.rest_length, h = net.h(), k = s.stiffness, c = s.damping;
    const long double l = glm::length(d), after = glm::length(d + step);
    Rise out;
    // (after - rest)^2 - (l - rest)^2, without the loss of the difference.
    const long double longer = l + after > 0 ? glm::dot(step, d + d + step) / (l + after) : 0;
    out.value = h * h * k / 2 * longer * (after + l - 2 * rest);
    out.size = double(h * h * k * glm::length(step) * (l + after + rest)) * net.reach(s.b, s.a);
    if (l > 0)
    {
        // The damper's power over the substep: 1/2 c h (n.v)^2 after less before, n as before.
        const long double before = glm::dot(d, moved(s.a) - moved(s.b)) / l, more = glm::dot(d, step) / l;
        out.value += c * h / 2 * ((before + more) * (before + more) - before * before);
        const long double far = glm::length(moved(s.a)) + glm::length(moved(s.b)) + glm::length(step);
        out.size += double(c * h * glm::length(step) * far) * net.reach(s.b, s.a);
    }
    return out;
}

using Long33 = glm::mat<3, 3, long double>;

long double shape_of(const Long33& f)
{
    return glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
}

/// The energy itself, before and after, in long double. steps: of the corners.
template <typename Real>
Rise solid(const SolidNet<Real>& in, std::size_t k, const std::array<Long3, 4>& steps)
{
    const auto& t = in.solids[k];
    const auto v = in.corners(k);
    Long33 now(0), way(0);
    const Long33 b(inverse_rest(t));
    double size = 0, moved = 0;
    for (int e = 0; e < 3; ++e)
    {
        const auto far = v[static_cast<std::size_t>(e) + 1];
        now[e] = (Long3(in.net.position[far]) - Long3(in.net.position[v[0]])) +
                 (Long3(in.net.delta[far]) - Long3(in.net.delta[v[0]]));
        way[e] = steps[static_cast<std::size_t>(e) + 1] - steps[0];
        const double row = glm::length(row_of(t, static_cast<std::size_t>(e) + 1));
        size += glm::length(in.net.between(v[0], far)) * in.net.reach(v[0], far) * row;
        moved += double(glm::length(steps[static_cast<std::size_t>(e) + 1]) + glm::length(steps[0])) * row;
    }
    const Long33 f = now * b, after = (now + way) * b;
    const long double mu = t.mu, lambda = t.lambda, rest = t.rest, log = t.log_term;
    const long double shape = shape_of(f), later = shape_of(after);
    const long double volume = glm::determinant(f), then = glm::determinant(after);
    long double rise = mu / 2 * (later - shape) + lambda / 2 * (then - volume) * (then + volume - 2 * rest);
    rise -= log * mu / 2 * std::log1p((later - shape) / (shape + 1));
    const long double units = in.net.h() * in.net.h() * double(t.volume);
    const double both = size + moved, cubes = both * both * both + double(rest);
    return {units * rise, double(units) * moved * (double(mu) * both + double(lambda) * cubes * both * both)};
}

} // namespace

TEMPLATE_TEST_CASE("implicit_trial sums what a step and its halves add to the potential", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "springs", "solids");
    const auto [first, trials] = GENERATE(std::pair(0u, 1u), std::pair(0u, 5u), std::pair(3u, 17u));
    for (const std::uint32_t count : {4u, 63u, 65u, 129u, 300u})
    {
        const SolidNet<Real> in = random_solids<Real>(count, count, 970 + count);
        Net<Real> net = random_net<Real>(count, 970 + count);
        if (variant == "solids")
            net = in.net;
        Dealt dealt;
        dealt.count = static_cast<std::uint32_t>(variant == "springs" ? net.springs.size()
                                                 : variant == "solids" ? in.solids.size()
                                                                       : count);
        dealt.groups = dealt.count > 200 ? 3 : 1;
        dealt.spare = 1;
        CAPTURE(variant, first, trials, count);
        Random random(971 + count);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = net.held[k] != 0 ? Real(0) : x[k] * Real(0.5);
        const std::uint32_t parts = 3, part = 1;
        Case c;
        c.precision = precision_of<Real>();
        c.in = net.buffers();
        c.in["solid"] = bytes_of(in.solids);
        c.in["x"] = bytes_of(x);
        c.in["partials"] = bytes_of(std::vector<Real>(trials * parts * dealt.groups, Real(7)));
        const kernels::implicit_trial::Params params{
            dealt.count, dealt.chunk(), dealt.groups, first, trials, part, parts, net.scale, net.lift};
        c.launches = {
            make_launch(kernels::implicit_trial::info(variant, c.precision), params, dealt.dispatched())};
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
                Rise rise;
                if (variant == "springs")
                    rise = spring(net, net.springs[k],
                                  step(net.springs[k].a, share) - step(net.springs[k].b, share));
                else if (variant == "solids")
                {
                    std::array<Long3, 4> steps;
                    for (std::size_t v = 0; v < 4; ++v)
                        steps[v] = step(in.corners(k)[v], share);
                    rise = solid(in, k, steps);
                }
                else
                    rise = inertia(net, k, step(k, share));
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

TEMPLATE_TEST_CASE("implicit_trial leaves shorter steps alone where one before them lowers the potential", "",
                   float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "springs", "solids");
    const std::uint32_t lowers = GENERATE(0u, 2u), count = 65, parts = 3, groups = 2, first = 3, trials = 5;
    CAPTURE(variant, lowers);
    const SolidNet<Real> in = random_solids<Real>(count, count, 975);
    Random random(976);
    std::vector<Real> partials(trials * parts * groups, Real(7));
    partials[lowers * parts * groups] = Real(-36); // and 35 of the other parts and groups
    Case c;
    c.precision = precision_of<Real>();
    c.in = in.net.buffers();
    c.in["solid"] = bytes_of(in.solids);
    c.in["x"] = bytes_of(random_reals<Real>(random, 3 * count));
    c.in["partials"] = bytes_of(partials);
    const kernels::implicit_trial::Params params{4, 64, groups, first, trials, 1, parts, 1, 1};
    c.launches = {make_launch(kernels::implicit_trial::info(variant, c.precision), params, groups)};
    for (const Real value : partials)
        c.expected["partials"].add(double(value), 0);
    check_on_every_device(c);
}
