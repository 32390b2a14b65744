#include "taut/kernels/pbd_hub_spring.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_hub_spring::Params;

namespace {

/// A star of n spokes around vertex 0, with two spokes of another hub before and after.
template <typename Real>
PbdInput<Real> star(std::uint32_t n, Real hub_weight)
{
    Random random(2800 + n);
    auto in = pbd_vertices<Real>(random, n + 6);
    in.position[0].w = hub_weight;
    const auto add = [&](std::uint32_t a, std::uint32_t b) {
        in.spring.push_back({a, b, random.uniform<Real>(0.2, 2), Real(0)});
    };
    const std::uint32_t other = n + 1;
    add(other, n + 2);
    add(other, n + 3);
    for (const std::uint32_t spoke : random.shuffled(n))
        add(0, spoke + 1);
    add(other, n + 4);
    add(other, n + 5);
    if (n < 4)
        return in;
    for (const std::size_t k : {2, 3}) // no direction: counted, unless it is as it should be
    {
        in.position[in.spring[k].b] = glm::vec<4, Real>(glm::vec<3, Real>(in.position[0]), Real(1));
        in.delta[in.spring[k].b] = in.delta[0];
    }
    in.spring[3].rest_length = 0;
    in.position[in.spring[4].b].w = 0;
    return in;
}

} // namespace

TEMPLATE_TEST_CASE("a PBD hub moves by the mean of its copies and every spoke by its own spring", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t n = GENERATE(1u, 2u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u, 10000u);
    const double weight = GENERATE(1.0, 0.0, 1e-3);
    const float share = 0.75f;
    CAPTURE(n, weight);
    const auto in = star<Real>(n, static_cast<Real>(weight));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(in.spring)},
            {"position", bytes_of(in.position)},
            {"delta", bytes_of(in.delta)},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::pbd_hub_spring::info("", c.precision), Params{2, n, share, 1}, 1)};
    // Every spoke sees the hub where it was, with 1/n of its mass.
    State state = pbd_state(in, true), seen = state;
    seen.position[0].w *= n;
    glm::dvec3 sum(0);
    double size = 0;
    for (std::uint32_t k = 2; k < n + 2; ++k)
    {
        const Request r = request(seen, in.spring[k], share);
        state.events[TAUT_EVENT_DEGENERATE] += r.degenerate ? 1 : 0;
        const double w = state.position[r.vertex[1]].w;
        if (r.size[1] > 0)
            state.push(r.vertex[1], r.push[1] * w, w * r.size[1]);
        sum += r.push[0] * weight;
        size += r.size[0] * weight;
    }
    state.push(0, sum, size);
    c.expected["delta"] = state.delta_field();
    c.events = state.events;
    check_on_every_device(c);
}
