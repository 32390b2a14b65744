#include "taut/kernels/pressure.hpp"

#include "support/surface_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

template <typename Real>
struct Input
{
    using Vec = glm::vec<4, Real>;
    SurfaceNet<Real> net;
    std::vector<Vec> gradient, velocity;
    std::vector<Real> surface, partials;
    layout::StepValues<Real> step{};
};

/// Surfaces of `count` and 7 vertices, a point and one that is held. One gas has a constant pressure; the
/// volume of the third surface is next to none, that of the fourth has the other sign.
template <typename Real>
Input<Real> random_input(Random& random, std::uint32_t count, std::uint32_t chunk)
{
    Input<Real> in;
    in.net = surface_net<Real>(random, {count, 7}, chunk);
    in.step.substep = static_cast<Real>(0.002);
    const auto surfaces = static_cast<std::uint32_t>(in.net.triangles.size());
    for (std::uint32_t s = 0; s < surfaces; ++s)
    {
        const double rest = (s % 2 == 0 ? 1 : -1) * random.uniform(0.5, 2);
        in.surface.push_back(static_cast<Real>(rest));
        in.surface.push_back(static_cast<Real>(random.uniform(-50, 500)));
        in.surface.push_back(s == 1 ? Real(0) : Real(1));
    }
    std::vector<double> groups_of(surfaces, 0);
    for (std::uint32_t g = 0; g < in.net.group_count(); ++g)
        groups_of[in.net.groups[6 * g + 3]] += 1;
    for (std::uint32_t g = 0; g < in.net.group_count(); ++g)
    {
        const std::uint32_t s = in.net.groups[6 * g + 3];
        const double share = (s == 2 ? 1e-3 : s == 3 ? -0.5 : random.uniform(0.2, 3)) / groups_of[s];
        in.partials.push_back(static_cast<Real>(share * static_cast<double>(in.surface[3 * s])));
        in.partials.push_back(Real(9)); // not this kernel's
        in.partials.push_back(Real(9));
    }
    for (std::uint32_t e = 0; e < in.net.listed(); ++e)
        in.gradient.push_back(random.vec4<Real>(1e-2, in.net.position[in.net.list[2 * e]].w));
    in.velocity = random.vec4s<Real>(in.net.position.size(), 3, 0, 0);
    return in;
}

template <typename Real>
void expect_push(Case& c, const Input<Real>& in)
{
    const SurfaceNet<Real>& net = in.net;
    std::vector<double> value, scale;
    for (const auto& v : in.velocity)
        for (int k = 0; k < 4; ++k)
        {
            value.push_back(static_cast<double>(v[k]));
            scale.push_back(0);
        }
    for (std::uint32_t g = 0; g < net.group_count(); ++g)
    {
        const std::uint32_t s = net.groups[6 * g + 3];
        double volume = 0;
        for (std::uint32_t other = 0; other < net.group_count(); ++other)
            volume += net.groups[6 * other + 3] == s ? static_cast<double>(in.partials[3 * other]) : 0;
        const double share = volume / static_cast<double>(in.surface[3 * s]);
        const bool isothermal = in.surface[3 * s + 2] > Real(0);
        const double pressure = static_cast<double>(in.surface[3 * s + 1]) *
                                (!isothermal     ? 1
                                 : share >= 0.01 ? 1 / share
                                                 : 100);
        for (std::uint32_t e = net.groups[6 * g]; e < net.groups[6 * g + 1]; ++e)
            for (int k = 0; k < 3; ++k)
            {
                const double more = pressure * static_cast<double>(in.step.substep) *
                                    static_cast<double>(in.gradient[e][k]) *
                                    static_cast<double>(in.gradient[e].w);
                const std::size_t at = 4 * std::size_t(net.list[2 * e]) + static_cast<std::size_t>(k);
                value[at] += more;
                scale[at] = more == 0 ? 0 : std::abs(value[at]) + 2 * std::abs(more);
            }
    }
    for (std::size_t k = 0; k < value.size(); ++k)
        c.expected["velocity"].add(value[k], scale[k]);
}

} // namespace

TEMPLATE_TEST_CASE("pressure pushes each vertex along the gradient of its surface's volume", "[pressure]",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(4u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const bool report = GENERATE(false, true);
    CAPTURE(count, report);
    Random random(4300 + count);
    const Input<Real> in = random_input<Real>(random, count, 128);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(in.net.table())},
            {"surface", bytes_of(in.surface)},
            {"gradient", bytes_of(in.gradient)},
            {"partials", bytes_of(in.partials)},
            {"step_values", bytes_of(std::vector{in.step})},
            {"velocity", bytes_of(in.velocity)},
            {"events", no_events()}};
    // One group more than there is: what folding may bring.
    c.launches = {make_launch(kernels::pressure::info("", c.precision),
                              kernels::pressure::Params{in.net.group_count(), report},
                              in.net.group_count() + 1)};
    expect_push(c, in);
    c.events[TAUT_EVENT_DEGENERATE] = report ? 2 : 0; // next to no volume, and one turned inside out
    check_on_every_device(c);
}
