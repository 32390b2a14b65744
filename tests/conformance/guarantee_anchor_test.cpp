#include "taut/kernels/guarantee_anchor.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("guarantee_anchor bounds vertices by their forecast, and holds what the search left out",
                   "", float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const bool holds = GENERATE(false, true);
    CAPTURE(count, holds);
    Random random(3100 + count);
    auto position = random.vec4s<Real>(count + 2, 1, 0, 1);
    for (Vec& x : position)
        x.w = random.inverse_mass<Real>();
    position[0].w = Real(1);
    auto delta = random.vec4s<Real>(count + 2, 0.1, 0, 1);
    delta[0].y = Real(2e18); // finish would not take it
    std::vector<Vec> rest;
    for (std::uint32_t v = 0; v < count + 2; ++v)
        rest.push_back(random.vec4<Real>(1, Real(random.below(2))));
    const std::vector<layout::ContactBody<Real>> body = {{Real(0.01), Real(0), 1, 1, 1, 1},
                                                         {Real(0.03), Real(0), 1, 1, 1, 2}};
    std::vector<std::uint32_t> start(count + 1, 0); // of corners of pairs
    for (std::uint32_t v = 0; v < count; ++v)
        start[v + 1] = start[v] + TAUT_CONTACT_CROWD + (v % 10 == 5 ? 1 : 0);
    std::vector<std::uint32_t> control(TAUT_CONTACT_WORDS, 0);
    control[TAUT_CONTACT_HOLDS] = holds ? 1 : 0;
    const std::uint32_t substeps = 3;
    const float skin = 0.02f;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},
            {"delta", bytes_of(delta)},
            {"rest", bytes_of(rest)},
            {"body", bytes_of(body)},
            {"control", bytes_of(control)},
            {"start", bytes_of(start)},
            {"anchor", bytes_of(std::vector<Vec>(2 * count + 4, Vec(9)))}};
    c.launches = {make_launch(kernels::guarantee_anchor::info("", c.precision),
                              kernels::guarantee_anchor::Params{count, substeps, skin}, count)};
    Field& field = c.expected["anchor"];
    for (std::uint32_t v = 0; v < count + 2; ++v)
    {
        const bool written = v<count, sound = v> 0;
        const glm::dvec3 forecast = sound ? double(substeps) * glm::dvec3(delta[v]) : glm::dvec3(0);
        const double radius = static_cast<double>(body[rest[v].w > 0 ? 1 : 0].radius);
        const double bound = 0.1 * glm::length(forecast) + 0.45 * (2 * radius + static_cast<double>(skin));
        const double free = holds || !sound || v % 10 == 5 ? -1 : bound;
        const double expected = position[v].w == Real(0) ? -2 - bound : free;
        for (int axis = 0; axis < 3; ++axis)
            field.add(written ? 0 : 9, 0);
        field.add(written ? expected : 9, written && expected != -1 ? 2 + bound : 0);
        for (int axis = 0; axis < 3; ++axis)
            field.add(written ? forecast[axis] : 9, written ? std::abs(forecast[axis]) : 0);
        field.add(written ? 0 : 9, 0);
    }
    check_on_every_device(c);
}
