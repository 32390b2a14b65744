#include "taut/kernels/implicit_product.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_product multiplies with springs formed from places", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "dot", "residual");
    for (const Dealt& dealt : deals())
    {
        if (dealt.count > 1000)
            continue;
        CAPTURE(variant, dealt.count, dealt.groups);
        const std::uint32_t count = dealt.count;
        const Net<Real> net = random_net<Real>(count, 950 + count);
        Random random(951 + count);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = net.held[k] != 0 ? Real(0) : x[k]; // as the solver keeps it
        const auto b = random_reals<Real>(random, 3 * count);
        Case c;
        c.precision = precision_of<Real>();
        c.in = net.buffers();
        c.in["x"] = bytes_of(x);
        c.in["b"] = bytes_of(b);
        c.in["y"] = bytes_of(std::vector<Real>(3 * count + 5, Real(7)));
        c.in["partials"] = bytes_of(std::vector<Real>(dealt.groups, Real(7)));
        const kernels::implicit_product::Params params{count, dealt.chunk(), dealt.groups, net.scale};
        c.launches = {
            make_launch(kernels::implicit_product::info(variant, c.precision), params, dealt.dispatched())};
        std::uint32_t unused = 0;
        const auto y = product_of(net, spring_system(net, unused), x);
        Field& field = c.expected["y"];
        GroupSums sums(dealt);
        for (std::uint32_t v = 0; v < count; ++v)
            for (std::uint32_t k = 0; k < 3; ++k)
            {
                const double value = double(net.scale) * y[v].value[static_cast<int>(k)];
                const double size = double(net.scale) * y[v].size, side = double(b[3 * v + k]);
                variant == "residual" ? field.add(side - value, std::abs(side) + size)
                                      : field.add(value, size);
                sums.add(v, double(x[3 * v + k]) * value, std::abs(double(x[3 * v + k])) * size);
            }
        for (int k = 0; k < 5; ++k)
            field.add(7, 0);
        if (variant == "dot")
            sums.put(c.expected["partials"]);
        look_on_every_device(c, nullptr);
    }
}
