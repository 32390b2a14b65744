#include "taut/kernels/implicit_force.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_force gathers M (guess - displacement) + h^2 f", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 1000u);
    const std::string variant = GENERATE("", "damped");
    CAPTURE(count, variant);
    const Net<Real> net = random_net<Real>(count, 910 + count);
    Case c;
    c.precision = precision_of<Real>();
    c.in = net.buffers();
    c.in["b"] = bytes_of(std::vector<Real>(3 * count, Real(7)));
    c.launches = {make_launch(kernels::implicit_force::info(variant, c.precision),
                              kernels::implicit_force::Params{count, net.scale, net.lift}, count)};
    std::vector<Sized> side(count);
    for (std::uint32_t v = 0; v < count; ++v)
    {
        const glm::dvec3 far = Net<Real>::wide(net.predicted[v]), near = Net<Real>::wide(net.delta[v]);
        side[v].add(net.mass(v) * (far - near), net.mass(v) * (glm::length(far) + glm::length(near)));
    }
    for (const auto& s : net.springs)
    {
        const SpringTerms t = spring_terms(net, s, variant == "damped");
        const double factor = net.h() * net.h();
        for (const auto& [v, sign] : {std::pair(s.a, 1.0), std::pair(s.b, -1.0)})
            if (net.solved(v))
                side[v].add(sign * factor * t.force.value, factor * t.force.size);
    }
    Field& b = c.expected["b"];
    const double units = double(net.scale) * double(net.lift);
    for (std::uint32_t v = 0; v < count; ++v)
        for (int k = 0; k < 3; ++k)
            b.add(units * side[v].value[k], units * side[v].size);
    check_on_every_device(c);
}
