#include "taut/kernels/corner_product.hpp"

#include "support/volume_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("corner_product is what the moves of all corners do to each volume", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const std::string variant = GENERATE("", "dot", "residual");
    CAPTURE(dealt.count, dealt.groups, variant);
    Random random(90 + dealt.count);
    const VolumeNet<Real> net = random_volume_net<Real>(random, dealt.count + 3);
    const auto spread = random.vec4s<Real>(net.vertices(), 10, -5, 5); // w must not matter
    std::vector<Real> b;
    for (std::size_t r = 0; r < net.x.size(); ++r)
        b.push_back(random.uniform<Real>(-10, 10));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"corners", bytes_of(net.row)},
            {"gradient", bytes_of(net.gradient)},
            {"spread", bytes_of(spread)},
            {"x", bytes_of(net.x)},
            {"y", bytes_of(std::vector<Real>(net.x.size(), Real(7)))},
            {"partials", bytes_of(std::vector<Real>(dealt.groups, Real(7)))},
            {"b", bytes_of(b)}};
    c.launches = {
        make_launch(kernels::corner_product::info(variant, c.precision),
                    kernels::corner_product::Params{dealt.count, dealt.chunk(), net.first, dealt.groups},
                    dealt.dispatched())};
    GroupSums sums(dealt);
    for (std::uint32_t k = 0; k < net.first; ++k)
        c.expected["y"].add(7, 0);
    for (std::uint32_t r = 0; r < net.rows(); ++r)
    {
        if (r >= dealt.count)
        {
            c.expected["y"].add(7, 0);
            continue;
        }
        const std::uint32_t v[4] = {net.row[r].a, net.row[r].b, net.row[r].c, net.row[r].d};
        const double x = net.x[net.first + r], soft = static_cast<double>(net.gradient[3 * r].w) * x;
        double value = soft, size = std::abs(soft);
        for (std::uint32_t k = 0; k < 4; ++k)
        {
            value += glm::dot(net.gradient_of(r, k), glm::dvec3(spread[v[k]]));
            size += net.scale_of(r) * glm::length(glm::dvec3(spread[v[k]]));
        }
        const double right = b[net.first + r];
        if (variant == "residual")
            c.expected["y"].add(right - value, size + std::abs(right));
        else
            c.expected["y"].add(value, size);
        sums.add(r, x * value, std::abs(x) * size);
    }
    if (variant == "dot")
    {
        Field added;
        sums.put(added);
        for (std::size_t k = 0; k < added.value.size(); ++k) // on what is there
            c.expected["partials"].add(7 + added.value[k], 7 + added.scale[k]);
    }
    check_on_every_device(c);
}
