#include "taut/kernels/implicit_euler_product_hinge.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_euler_product_hinge adds hinges formed from places", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "dot", "residual");
    for (const Dealt& dealt : deals())
    {
        if (dealt.count > 1000)
            continue;
        CAPTURE(variant, dealt.count, dealt.groups);
        const std::uint32_t count = dealt.count;
        const Net<Real> net = random_net<Real>(count, 960 + count);
        Random random(961 + count);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = net.held[k] != 0 ? Real(0) : x[k];
        const auto y = random_reals<Real>(random, 3 * count);
        Case c;
        c.precision = precision_of<Real>();
        c.in = net.buffers();
        if (net.hinges.empty()) // a buffer has bytes
            c.in["constraint"] = Bytes(sizeof(layout::BendingConstraint<Real>));
        c.in["table"] = bytes_of(net.hinge_table);
        c.in["x"] = bytes_of(x);
        c.in["y"] = bytes_of(y);
        c.in["partials"] = bytes_of(std::vector<Real>(dealt.groups, Real(7)));
        const kernels::implicit_euler_product_hinge::Params params{count, dealt.chunk(), dealt.groups,
                                                                   net.scale};
        c.launches = {make_launch(kernels::implicit_euler_product_hinge::info(variant, c.precision), params,
                                  dealt.dispatched())};
        std::uint32_t unused = 0;
        const auto more = product_of(net, hinge_system(net, unused), x);
        Field& field = c.expected["y"];
        GroupSums sums(dealt);
        for (std::uint32_t v = 0; v < count; ++v)
            for (std::uint32_t k = 0; k < 3; ++k)
            {
                const double sign = variant == "residual" ? -1 : 1, old = double(y[3 * v + k]);
                const double value = old + sign * double(net.scale) * more[v].value[static_cast<int>(k)];
                const double size = std::abs(old) + double(net.scale) * more[v].size;
                field.add(value, size);
                sums.add(v, double(x[3 * v + k]) * value, std::abs(double(x[3 * v + k])) * size);
            }
        if (variant == "dot")
            sums.put(c.expected["partials"]);
        look_on_every_device(c, nullptr);
    }
}
