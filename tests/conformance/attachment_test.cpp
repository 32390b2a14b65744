#include "taut/kernels/attachment.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("an attached vertex ends within its distance of the pin, others stay", "[attachment]",
                   float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint64_t seed = 1400 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const std::uint32_t pins = 5, vertices = 2 * count + pins + 3; // only some are attached
    auto position = random.vec4s<Real>(vertices, 1, 0.5, 2);
    auto delta = random.vec4s<Real>(vertices, 1e-2, 0, 1e-3);
    auto order = random.shuffled(vertices - pins);
    std::vector<layout::Attachment<Real>> attachment;
    for (std::uint32_t i = 0; i < count; ++i)
        attachment.push_back({pins + order[i], random.below(pins), random.uniform<Real>(0.1, 2)});
    for (std::uint32_t p = 0; p < pins; ++p)
        position[p].w = Real(0);
    if (count > 2) // at its pin; a limit of nothing
    {
        position[attachment[0].vertex] = Vec(glm::vec<3, Real>(position[attachment[0].pin]), Real(1));
        delta[attachment[0].vertex] = delta[attachment[0].pin];
        attachment[1].limit = Real(0);
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"attachment", bytes_of(attachment)},
            {"position", bytes_of(position)},
            {"delta", bytes_of(delta)}};
    c.launches = {make_launch(kernels::attachment::info("", c.precision), kernels::attachment::Params{count},
                              count)};
    Field& expected = c.expected["delta"];
    for (const Vec& d : delta)
        for (int k = 0; k < 4; ++k)
            expected.add(static_cast<double>(d[k]), 0);
    std::uint32_t beyond = 0;
    for (const auto& a : attachment)
    {
        const glm::dvec3 x(position[a.vertex]), d(delta[a.vertex]);
        const glm::dvec3 pin = glm::dvec3(position[a.pin]) + glm::dvec3(delta[a.pin]);
        const double away = glm::distance(x + d, pin), limit = static_cast<double>(a.limit);
        if (!(away > limit))
            continue;
        ++beyond;
        const glm::dvec3 moved = pin + (x + d - pin) * (limit / away) - x;
        for (int k = 0; k < 3; ++k)
        {
            expected.value[4 * a.vertex + static_cast<std::size_t>(k)] = moved[k];
            expected.scale[4 * a.vertex + static_cast<std::size_t>(k)] = away + glm::length(d) + limit;
        }
    }
    CHECK((count < 63 || (beyond > count / 4 && beyond < count)));
    check_on_every_device(c);
}
