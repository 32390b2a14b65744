#include "taut/kernels/implicit_solid_product.hpp"

#include "support/solid_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_solid_product adds tetrahedra", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "dot", "residual");
    for (const Dealt& dealt : deals())
    {
        if (dealt.count > 1000)
            continue;
        CAPTURE(variant, dealt.count, dealt.groups);
        const std::uint32_t count = dealt.count;
        const SolidNet<Real> in = random_solids<Real>(count, count, 1010 + count);
        Random random(1011 + count);
        auto state =
            random_reals<Real>(random, std::max<std::size_t>(1, in.solids.size()) * TAUT_SOLID_STATE);
        auto x = random_reals<Real>(random, 3 * count);
        for (std::uint32_t k = 0; k < 3 * count; ++k)
            x[k] = in.net.held[k] != 0 ? Real(0) : x[k];
        const auto y = random_reals<Real>(random, 3 * count);
        Case c;
        c.precision = precision_of<Real>();
        c.in = in.net.buffers();
        c.in["solid"] = bytes_of(in.solids);
        if (in.solids.empty()) // a buffer has bytes
            c.in["solid"] = Bytes(sizeof(layout::SolidTetrahedron<Real>));
        c.in["state"] = bytes_of(state);
        c.in["table"] = bytes_of(in.table);
        c.in["x"] = bytes_of(x);
        c.in["y"] = bytes_of(y);
        c.in["partials"] = bytes_of(std::vector<Real>(dealt.groups, Real(7)));
        const kernels::implicit_solid_product::Params params{count, dealt.chunk(), dealt.groups};
        c.launches = {make_launch(kernels::implicit_solid_product::info(variant, c.precision), params,
                                  dealt.dispatched())};
        const auto more = product_of(in.net, solid_system(in, state), x);
        Field& field = c.expected["y"];
        GroupSums sums(dealt);
        for (std::uint32_t v = 0; v < count; ++v)
            for (std::uint32_t k = 0; k < 3; ++k)
            {
                const double sign = variant == "residual" ? -1 : 1, old = double(y[3 * v + k]);
                const double value = old + sign * more[v].value[static_cast<int>(k)];
                const double size = std::abs(old) + more[v].size;
                field.add(value, size);
                sums.add(v, double(x[3 * v + k]) * value, std::abs(double(x[3 * v + k])) * size);
            }
        if (variant == "dot")
            sums.put(c.expected["partials"]);
        look_on_every_device(c, nullptr);
    }
}
