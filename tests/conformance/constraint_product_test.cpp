#include "taut/kernels/constraint_product.hpp"

#include "support/constraint_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("constraint_product is what the moves of both ends do to each length", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const std::string variant = GENERATE("", "dot", "residual");
    CAPTURE(dealt.count, dealt.groups, variant);
    Random random(60 + dealt.count);
    const RowNet<Real> net = random_row_net<Real>(random, dealt.count + 3);
    const auto spread = random.vec4s<Real>(net.vertices(), 10, -5, 5); // w must not matter
    const std::vector<Real> b = random_reals<Real>(random, net.rows(), -10, 10);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(net.row)},
            {"direction", bytes_of(net.direction)},
            {"spread", bytes_of(spread)},
            {"x", bytes_of(net.p)},
            {"y", bytes_of(std::vector<Real>(net.rows(), Real(7)))},
            {"partials", bytes_of(std::vector<Real>(dealt.groups, Real(7)))},
            {"b", bytes_of(b)}};
    c.launches = {make_launch(kernels::constraint_product::info(variant, c.precision),
                              kernels::constraint_product::Params{dealt.count, dealt.chunk(), dealt.groups},
                              dealt.dispatched())};
    GroupSums sums(dealt);
    for (std::uint32_t r = 0; r < net.rows(); ++r)
    {
        if (r >= dealt.count)
        {
            c.expected["y"].add(7, 0);
            continue;
        }
        const glm::dvec3 n = wide3(net.direction[r]);
        const glm::dvec3 ta = wide3(spread[net.row[r].a]), tb = wide3(spread[net.row[r].b]);
        const double p = static_cast<double>(net.p[r]), soft = static_cast<double>(net.direction[r].w) * p;
        const double value = glm::dot(n, ta - tb) + soft;
        const double size = glm::length(n) * (glm::length(ta) + glm::length(tb)) + std::abs(soft);
        const double right = static_cast<double>(b[r]);
        if (variant == "residual")
            c.expected["y"].add(right - value, size + std::abs(right));
        else
            c.expected["y"].add(value, size);
        sums.add(r, p * value, std::abs(p) * size);
    }
    if (variant == "dot")
        sums.put(c.expected["partials"]);
    check_on_every_device(c);
}
