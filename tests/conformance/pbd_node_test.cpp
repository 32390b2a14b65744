#include "taut/kernels/pbd_node.hpp"

#include "support/pbd_jacobi.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::pbd_node::Params;

TEMPLATE_TEST_CASE("a vertex takes the average of what its springs, hinges and tetrahedra want", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const JacobiCase of = jacobi_case();
    const bool report = GENERATE(true, false);
    CAPTURE(count, of.variant(), report);
    auto in = jacobi_input<Real>(count, 2400 + count);
    plant_springs(in, 0, in.spring_colours[1]);
    const AtVertices at = at_vertices(in);
    const float relaxation = 1.5f, omega = of.chebyshev ? 1.7f : 1.0f;
    Case c;
    c.precision = precision_of<Real>();
    c.in = jacobi_buffers(in);
    const auto vertices = static_cast<std::uint32_t>(in.position.size());
    c.launches = {make_launch(kernels::pbd_node::info(of.variant(), c.precision),
                              Params{vertices, of.stretch, of.bend, of.volume, relaxation, omega, report,
                                     at.hinges, at.volumes},
                              vertices)};
    const JacobiReference<Real> reference(in, of, relaxation, omega, report);
    c.expected["next"] = reference.next;
    c.events = reference.events;
    check_on_every_device(c);
}
