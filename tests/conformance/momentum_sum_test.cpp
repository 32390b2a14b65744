#include "taut/kernels/momentum_sum.hpp"

#include "support/rigid_sums.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("momentum_sum sums what sweeps took of bodies' angular momentum, and their moments", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const double far = GENERATE(0.0, 100.0); // of the bodies from the origin
    CAPTURE(count, far);
    Random random(1480 + count);
    const BodyParts parts = deal_parts(count);
    auto position = random.vec4s<Real>(count, 1, 0.1, 10); // w: inverse mass
    for (auto& x : position)
        x.x += Real(far);
    const auto before = random.vec4s<Real>(count, 1e-2, 0, 1), delta = random.vec4s<Real>(count, 1e-2, 0, 1);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind({}))},
            {"before", bytes_of(before)},
            {"delta", bytes_of(delta)},
            {"sums", bytes_of(std::vector<Real>(TAUT_MOMENTUM_SUMS * parts.groups + 3, Real(7)))},
            {"position", bytes_of(position)}};
    c.launches = {make_launch(kernels::momentum_sum::info("", c.precision),
                              kernels::momentum_sum::Params{parts.groups}, parts.groups)};
    Field& field = c.expected["sums"];
    for (const BodyParts::Part& part : parts.parts)
    {
        const MomentumSums sums = momentum_sums(parts, part, position, before, delta);
        for (std::size_t k = 0; k < TAUT_MOMENTUM_SUMS; ++k)
            field.add(sums.value[k], sums.size[k]);
    }
    for (int k = 0; k < 3; ++k)
        field.add(7, 0);
    check_on_every_device(c);
}
