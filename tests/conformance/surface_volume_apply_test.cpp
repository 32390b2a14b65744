#include "taut/kernels/surface_volume_apply.hpp"

#include "support/surface_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

struct Mode
{
    std::uint32_t iteration = 0;
    bool kept = false, report = false;
};

/// Kernel inputs that do not lie in the net.
template <typename Real>
struct Input
{
    using Vec = glm::vec<4, Real>;
    SurfaceNet<Real> net;
    std::vector<Vec> gradient;
    std::vector<Real> partials, multiplier;
    layout::StepValues<Real> step{};
};

template <typename Real>
Input<Real> random_input(Random& random, std::uint32_t count, std::uint32_t chunk, std::uint32_t rows)
{
    Input<Real> in;
    in.net = surface_net<Real>(random, {count, 7}, chunk);
    in.step.inverse_substep = static_cast<Real>(1000);
    const std::uint32_t surfaces = static_cast<std::uint32_t>(in.net.triangles.size());
    for (std::uint32_t e = 0; e < in.net.listed(); ++e)
        in.gradient.push_back(random.vec4<Real>(1e-2, in.net.position[in.net.list[2 * e]].w));
    for (std::uint32_t group = 0; group < in.net.group_count(); ++group)
    {
        const bool usable = in.net.groups[6 * group + 3] + 2 < surfaces; // behind: a point, and all held
        in.partials.push_back(random.uniform<Real>(-1, 1));
        in.partials.push_back(random.uniform<Real>(-0.1, 0.1));
        in.partials.push_back(usable ? random.uniform<Real>(0.1, 1) : Real(0));
    }
    for (std::uint32_t k = 0; k < rows * surfaces; ++k)
        in.multiplier.push_back(k < surfaces ? Real(0) : random.uniform<Real>(-1e-6, 1e-6));
    return in;
}

/// The multiplier of a surface and the size of its terms.
template <typename Real>
std::pair<double, double> pull_of(const Input<Real>& in, std::uint32_t surface, const Mode& mode)
{
    double sum[3] = {}, size[2] = {};
    for (std::uint32_t group = 0; group < in.net.group_count(); ++group)
        if (in.net.groups[6 * group + 3] == surface)
            for (std::uint32_t k = 0; k < 3; ++k)
            {
                const double part = in.partials[3 * group + k];
                sum[k] += part;
                size[std::min(k, 1u)] += k < 2 ? std::abs(part) : 0;
            }
    const double rest = in.net.surface[2 * surface], rate = in.step.inverse_substep;
    const double soft = std::min(static_cast<double>(in.net.surface[2 * surface + 1]) * rate * rate,
                                 static_cast<double>(static_cast<Real>(1e30)));
    const std::size_t row = mode.iteration * in.net.triangles.size() + surface;
    const double before = mode.kept ? static_cast<double>(in.multiplier[row]) : 0;
    const double value = sum[0] - rest + (mode.iteration == 0 ? sum[1] : 0) - soft * before;
    const double scale = size[0] + std::abs(rest) + size[1] + soft * std::abs(before);
    if (!(sum[2] > 0))
        return {0, 0};
    return {value / (sum[2] + soft), scale / (sum[2] + soft)};
}

template <typename Real>
void expect_moves(Case& c, const Input<Real>& in, const Mode& mode)
{
    const SurfaceNet<Real>& net = in.net;
    std::vector<double> value, scale;
    for (const auto& d : in.net.delta)
        for (int k = 0; k < 4; ++k)
        {
            value.push_back(d[k]);
            scale.push_back(0);
        }
    std::vector<double> multiplier(in.multiplier.begin(), in.multiplier.end()), loose(multiplier.size(), 0);
    const auto surfaces = static_cast<std::uint32_t>(net.triangles.size());
    for (std::uint32_t s = 0; s < surfaces; ++s)
    {
        const auto [pull, size] = pull_of(in, s, mode);
        for (std::uint32_t group = 0; group < net.group_count(); ++group)
            for (std::uint32_t e = net.groups[6 * group];
                 net.groups[6 * group + 3] == s && e < net.groups[6 * group + 1]; ++e)
                for (int k = 0; k < 3; ++k)
                {
                    const double turn = static_cast<double>(in.gradient[e][k]) * in.gradient[e].w;
                    const std::size_t at = 4 * net.list[2 * e] + static_cast<std::size_t>(k);
                    value[at] -= pull * turn;
                    scale[at] = turn == 0 || size == 0 ? 0 : std::abs(value[at]) + std::abs(turn) * size;
                }
        if (!mode.kept)
            continue;
        const std::size_t row = (mode.iteration + 1) * surfaces + s;
        multiplier[row] = multiplier[row - surfaces] + pull;
        loose[row] = std::abs(multiplier[row - surfaces]) + size;
    }
    for (std::size_t k = 0; k < value.size(); ++k)
        c.expected["delta"].add(value[k], scale[k]);
    for (std::size_t k = 0; mode.kept && k < multiplier.size(); ++k)
        c.expected["multiplier"].add(multiplier[k], loose[k]);
}

} // namespace

TEMPLATE_TEST_CASE("surface_volume_apply moves each vertex by its surface's multiplier", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(4u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    Mode mode;
    mode.iteration = GENERATE(0u, 2u);
    mode.kept = GENERATE(false, true);
    mode.report = GENERATE(false, true);
    CAPTURE(count, mode.iteration, mode.kept, mode.report);
    Random random(4200 + count);
    const Input<Real> in = random_input<Real>(random, count, 128, mode.iteration + 2);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(in.net.table())},
            {"surface", bytes_of(in.net.surface)},
            {"gradient", bytes_of(in.gradient)},
            {"partials", bytes_of(in.partials)},
            {"step_values", bytes_of(std::vector{in.step})},
            {"delta", bytes_of(in.net.delta)},
            {"events", no_events()},
            {"multiplier", bytes_of(in.multiplier)}};
    const auto surfaces = static_cast<std::uint32_t>(in.net.triangles.size());
    c.launches = {make_launch(
        kernels::surface_volume_apply::info(mode.kept ? "kept" : "", c.precision),
        kernels::surface_volume_apply::Params{in.net.group_count(), surfaces, mode.iteration, mode.report},
        in.net.group_count() + 1)};
    expect_moves(c, in, mode);
    c.events[TAUT_EVENT_DEGENERATE] = mode.report ? 2 : 0; // the point, and the one that is held
    check_on_every_device(c);
}
