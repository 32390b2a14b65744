#include "taut/kernels/pin_motion.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE(
    "a moving pin is on the line between its two places, and at the second one after the last substep", "",
    float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const auto [substeps, substep] =
        GENERATE(std::pair(1u, 0u), std::pair(7u, 0u), std::pair(7u, 3u), std::pair(7u, 6u));
    const std::uint64_t seed = 300 + count + substep;
    INFO("count " << count << ", substep " << substep << " of " << substeps << ", seed " << seed);
    Random random(seed);
    const std::uint32_t vertices = 2 * count + 5; // only some are pins
    auto vertex = random.shuffled(vertices);
    vertex.resize(count);
    const auto target = random.vec4s<Real>(2 * count, 3, -1, 1);
    const auto position = random.vec4s<Real>(vertices, 3, 0, 1);
    const auto delta = random.vec4s<Real>(vertices, 1e-2, 0, 1e-3);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"vertex", bytes_of(vertex)},
            {"pin_target", bytes_of(target)},
            {"position", bytes_of(position)},
            {"delta", bytes_of(delta)}};
    c.launches = {make_launch(kernels::pin_motion::info("", c.precision),
                              kernels::pin_motion::Params{count, substep, substeps}, count)};
    Field& expected = c.expected["delta"];
    for (const auto& d : delta)
        for (int k = 0; k < 4; ++k)
            expected.add(static_cast<double>(d[k]), 0);
    for (std::uint32_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k)
        {
            const double from = static_cast<double>(target[2 * i][k]),
                         to = static_cast<double>(target[2 * i + 1][k]);
            const double at = static_cast<double>(position[vertex[i]][k]);
            const double part = (substep + 1.0) / substeps;
            expected.value[4 * vertex[i] + static_cast<std::size_t>(k)] = (1 - part) * from + part * to - at;
            expected.scale[4 * vertex[i] + static_cast<std::size_t>(k)] =
                std::abs(from) + std::abs(to) + std::abs(at);
        }
    check_on_every_device(c);
}
