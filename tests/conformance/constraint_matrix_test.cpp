#include "taut/kernels/constraint_matrix.hpp"

#include "support/constraint_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("constraint_matrix gives each pair of rows weight times the cosine between them", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    CAPTURE(count);
    Random random(70 + count);
    const RowNet<Real> net = random_row_net<Real>(random, 40);
    const std::uint32_t all = count + 5; // five behind the count stay as they are
    std::vector<std::uint32_t> pair;
    for (std::uint32_t k = 0; k < all; ++k)
    {
        const std::uint32_t r = random.below(40);
        pair.insert(pair.end(), {r, k % 3 == 0 ? r : random.below(40)});
    }
    const std::vector<Real> weight = random_reals<Real>(random, all, -100, 100);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pair)},
            {"weight", bytes_of(weight)},
            {"direction", bytes_of(net.direction)},
            {"values", bytes_of(std::vector<Real>(all, Real(7)))}};
    c.launches = {make_launch(kernels::constraint_matrix::info("", c.precision),
                              kernels::constraint_matrix::Params{count}, count)};
    for (std::uint32_t k = 0; k < all; ++k)
    {
        const auto& n = net.direction[pair[2 * k]];
        const double soft = pair[2 * k] == pair[2 * k + 1] ? static_cast<double>(n.w) : 0;
        const double w = static_cast<double>(weight[k]);
        const double value = w * glm::dot(wide3(n), wide3(net.direction[pair[2 * k + 1]])) + soft;
        c.expected["values"].add(k < count ? value : 7, k < count ? std::abs(w) + soft : 0);
    }
    check_on_every_device(c);
}
