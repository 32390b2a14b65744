#include "taut/kernels/pbd_node.hpp"

#include "support/pbd_cases.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_node::Params;

TEMPLATE_TEST_CASE("a vertex takes the average of what its springs and hinges want", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const bool hinges = GENERATE(false, true), chebyshev = GENERATE(false, true);
    const bool report = GENERATE(true, false);
    CAPTURE(count, hinges, chebyshev, report);
    auto in = jacobi_input<Real>(count, 2400 + count);
    if (in.spring.empty())
        in.spring.resize(1); // no buffer is empty
    else
        plant_springs(in, 0, in.spring_colours[1]);
    const float stretch = 0.75f, bend = 0.3f, relaxation = 1.5f, omega = chebyshev ? 1.7f : 1.0f;
    Case c;
    c.precision = precision_of<Real>();
    c.in = jacobi_buffers(in);
    const auto vertices = static_cast<std::uint32_t>(in.position.size());
    c.launches = {make_launch(kernels::pbd_node::info(jacobi_variant(hinges, chebyshev), c.precision),
                              Params{vertices, stretch, bend, relaxation, omega, report}, vertices)};
    const JacobiReference<Real> reference(in, hinges, stretch, bend, relaxation, omega, report);
    c.expected["next"] = reference.next;
    c.events = reference.events;
    check_on_every_device(c);
}
