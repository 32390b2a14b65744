#include "taut/kernels/corner_spread.hpp"

#include "support/volume_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("corner_spread adds what the rows of tetrahedra move each vertex by", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool apply = GENERATE(false, true);
    const std::uint32_t status =
        GENERATE(std::uint32_t(TAUT_CG_CONVERGED), std::uint32_t(TAUT_CG_ZERO_RIGHT_HAND_SIDE));
    CAPTURE(dealt.count, dealt.groups, apply, status);
    Random random(80 + dealt.count);
    const VolumeNet<Real> net = random_volume_net<Real>(random, 2 * dealt.count);
    const auto spread = random.vec4s<Real>(net.vertices(), 10, -5, 5);
    layout::CgState<Real> state;
    std::memset(static_cast<void*>(&state), 0, sizeof(state));
    state.status = status;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(net.start)},       {"incident", bytes_of(net.incident)},
            {"gradient", bytes_of(net.gradient)}, {"x", bytes_of(net.x)},
            {"position", bytes_of(net.position)}, {"delta", bytes_of(net.delta)},
            {"spread", bytes_of(spread)},         {"state", bytes_of(std::vector{state})}};
    c.launches = {make_launch(kernels::corner_spread::info(apply ? "apply" : "", c.precision),
                              kernels::corner_spread::Params{dealt.count, dealt.chunk(), net.first},
                              dealt.dispatched())};
    Field& out = c.expected[apply ? "delta" : "spread"];
    for (std::uint32_t v = 0; v < net.vertices(); ++v)
    {
        const auto& before = apply ? net.delta[v] : spread[v];
        glm::dvec3 sum(0);
        double size = 0;
        for (std::uint32_t k = net.start[v]; k < net.start[v + 1]; ++k)
        {
            const std::uint32_t r = net.incident[k] / 4;
            const double x = net.x[net.first + r];
            sum += net.gradient_of(r, net.incident[k] % 4) * x;
            size += net.scale_of(r) * std::abs(x);
        }
        const bool visited = v < dealt.count;
        const bool moves = visited && !(apply && status == TAUT_CG_ZERO_RIGHT_HAND_SIDE);
        const double w = moves ? static_cast<double>(net.position[v].w) : 0;
        for (int k = 0; k < 3; ++k)
            out.add(static_cast<double>(before[k]) + (apply ? -w : w) * sum[k],
                    w > 0 ? std::abs(static_cast<double>(before[k])) + w * size : 0);
        out.add(visited && !apply ? 0 : static_cast<double>(before.w), 0);
    }
    check_on_every_device(c);
}
