#include "taut/kernels/mass_spring_hinge.hpp"

#include "support/hinge_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("mass_spring_hinge leaves in each corner's slot the torque times the angle's gradient", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t hinges = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t first = GENERATE(0u, 5u);
    const std::uint32_t report = GENERATE(0u, 1u);
    const std::uint64_t seed = 990 + hinges;
    CAPTURE(hinges, first, report, seed);
    Random random(seed);
    const auto net = hinge_net<Real>(random, hinges);
    const auto count = static_cast<std::uint32_t>(net.hinge.size()) - 1; // the last is left alone
    const auto before = random.vec4s<Real>(first + 4 * net.hinge.size(), 100, 0, 0);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"constraint", bytes_of(net.hinge)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(net.low)},
            {"slot", bytes_of(before)},
            {"events", no_events()}};
    c.launches = {make_launch(kernels::mass_spring_hinge::info("", c.precision),
                              kernels::mass_spring_hinge::Params{count, first, report}, count)};
    Field& field = c.expected["slot"];
    for (const auto& slot : before)
        for (int k = 0; k < 4; ++k)
            field.add(double(slot[k]), 0);
    for (std::uint32_t k = 0; k < count; ++k)
        for (std::uint32_t corner = 0; corner < 4; ++corner)
        {
            double size = 0;
            const HingeTerm term = hinge_term(net.hinge[k], net.places(k, size), size, corner);
            const double stiff = 1 / double(net.hinge[k].compliance);
            const std::size_t at = 4 * (std::size_t{first} + 4 * k + corner);
            for (int axis = 0; axis < 4; ++axis)
            {
                const auto e = static_cast<std::size_t>(axis);
                field.value[at + e] = axis < 3 ? -term.gradient[axis] * (term.value * stiff) : 0;
                field.scale[at + e] = axis < 3 ? stiff * (term.gradient_scale * std::abs(term.value) +
                                                          glm::length(term.gradient) * term.value_scale)
                                               : 0;
            }
            c.events[TAUT_EVENT_DEGENERATE] += report != 0 && corner == 0 && !term.shaped ? 1 : 0;
        }
    check_on_every_device(c);
}
