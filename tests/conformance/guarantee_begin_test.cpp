#include "taut/kernels/guarantee_begin.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("guarantee_begin asks whom the bound does not let go all the way", "", float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(3500 + count);
    const auto position = random.vec4s<Real>(count + 2, 1, 0, 1),
               low = random.vec4s<Real>(count + 2, 1e-8, 0, 1);
    auto delta = random.vec4s<Real>(count + 2, 0.01, 0, 1), expected = delta;
    std::vector<Vec> anchor;
    std::vector<std::uint32_t> asked(count + 1, 0), next(count + 1, 0);
    std::uint32_t some = 0;
    for (std::uint32_t v = 0; v < count; ++v)
    {
        const double bound = random.uniform(0.002, 0.02), dice = random.uniform(0, 1);
        anchor.push_back(random.vec4<Real>(0.001, static_cast<Real>(dice < 0.1   ? -1
                                                                    : dice < 0.2 ? -2 - bound
                                                                                 : bound)));
        anchor.push_back(random.vec4<Real>(0.01, Real(0))); // the forecast, a line from 0
        const glm::dvec3 end = glm::dvec3(anchor[2 * v]) + glm::dvec3(delta[v]) - glm::dvec3(low[v]);
        const glm::dvec3 line(anchor[2 * v + 1]);
        const double way =
            glm::length(end - line * glm::clamp(glm::dot(end, line) / glm::dot(line, line), 0.0, 1.0));
        if (std::abs(way - bound) < 1e-6)
            delta[v] = expected[v] = low[v];
        const bool leaves = dice >= 0.2 && way > bound && delta[v] != low[v];
        asked[v] = (dice >= 0.1 && dice < 0.2) || (dice >= 0.2 && !leaves) ? 0 : 1;
        some += asked[v];
    }
    Case c;
    c.precision = precision_of<Real>();
    delta[0].y = std::numeric_limits<Real>::quiet_NaN(); // finish would not take it
    expected[0] = Vec(glm::vec<3, Real>(low[0]), delta[0].w);
    asked[0] = anchor[0].w == Real(-1) ? 1 : 0;
    c.in = {{"position", bytes_of(position)},
            {"low", bytes_of(low)},
            {"anchor", bytes_of(anchor)},
            {"delta", bytes_of(delta)},
            {"asked", bytes_of(std::vector<std::uint32_t>(count + 1, 9))},
            {"next", bytes_of(std::vector<std::uint32_t>(count + 1, 9))},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::guarantee_begin::info("", c.precision),
                              kernels::guarantee_begin::Params{count}, count)};
    c.events[TAUT_EVENT_NON_FINITE] = 1;
    for (const Vec& d : expected)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(static_cast<double>(d[k]), 0);
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(words_of(out, "asked") == asked);
        CHECK(words_of(out, "next") == next);
    });
    CHECK((count < 60 || (some > count / 10 && some < count)));
}
