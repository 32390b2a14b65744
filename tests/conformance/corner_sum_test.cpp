#include "taut/kernels/corner_sum.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("corner_sum adds the slots of the corners at each vertex", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t add = GENERATE(0u, 1u);
    CAPTURE(count, add);
    Random random(470 + count);
    const auto slots = static_cast<std::uint32_t>(3 * count);
    std::vector<std::uint32_t> start = {0}, incident;
    for (std::uint32_t v = 0; v < count; ++v) // none at some, many at the first
    {
        const std::uint32_t here = v == 0 ? std::min(slots, 300u) : random.below(6);
        for (std::uint32_t k = 0; k < here; ++k)
            incident.push_back(random.below(slots));
        start.push_back(static_cast<std::uint32_t>(incident.size()));
    }
    const auto slot = random.vec4s<Real>(slots, 10, 0, 0);
    const auto force = random.vec4s<Real>(count + 1, 100, 0, 0); // the last is no vertex of the pass

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},
            {"incident", bytes_of(incident)},
            {"slot", bytes_of(slot)},
            {"force", bytes_of(force)}};
    c.launches = {make_launch(kernels::corner_sum::info("", c.precision),
                              kernels::corner_sum::Params{count, add}, count)};
    Field& field = c.expected["force"];
    for (std::uint32_t v = 0; v <= count; ++v)
        for (int k = 0; k < 4; ++k)
        {
            double sum = v == count || (add != 0 && k < 3) ? double(force[v][k]) : 0, size = std::abs(sum);
            for (std::uint32_t j = v < count ? start[v] : 0; k < 3 && v < count && j < start[v + 1]; ++j)
            {
                sum += double(slot[incident[j]][k]);
                size += std::abs(double(slot[incident[j]][k]));
            }
            field.add(sum, v < count ? size : 0);
        }
    check_on_every_device(c);
}
