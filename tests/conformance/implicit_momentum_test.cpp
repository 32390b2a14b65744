#include "taut/kernels/implicit_momentum.hpp"

#include "support/implicit_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("implicit_momentum shifts every free part to where its centre of mass belongs", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t size = GENERATE(1u, 2u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u);
    const std::vector<std::uint32_t> sizes = {size, 1, 5, size + 3};
    std::uint32_t count = 9; // vertices of no part
    for (const std::uint32_t n : sizes)
        count += n;
    const bool contact = GENERATE(false, true); // a vertex of the first and of the third part is stopped
    CAPTURE(size, contact);
    Random random(990 + size);
    auto position = random.vec4s<Real>(count, 1, 0.1, 30);
    const auto delta = random.vec4s<Real>(count, 1e-2, 0, 1),
               predicted = random.vec4s<Real>(count, 1e-2, 0, 1);
    const auto x = random_reals<Real>(random, 3 * count);
    const std::vector<std::uint32_t> order = random.shuffled(count);
    std::vector<std::uint32_t> start = {0}, member(order.begin(), order.end() - 9);
    for (const std::uint32_t n : sizes)
        start.push_back(start.back() + n);
    const auto parts = static_cast<std::uint32_t>(sizes.size());
    constexpr double kLift = 64;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"position", bytes_of(position)},   {"delta", bytes_of(delta)},
            {"predicted", bytes_of(predicted)}, {"x", bytes_of(x)},
            {"start", bytes_of(start)},         {"member", bytes_of(member)}};
    std::vector<std::uint32_t> marks(3 * count, 0u);
    for (const std::uint32_t k : {start[1] - 1, start[2] + 2})
        std::fill_n(marks.begin() + 3 * member[k], 3, 1u);
    if (contact)
        c.in["marks"] = bytes_of(marks);
    c.launches = {make_launch(kernels::implicit_momentum::info(contact ? "contact" : "", c.precision),
                              kernels::implicit_momentum::Params{parts, float(kLift)}, parts + 1)};
    Field& field = c.expected["x"];
    add_unchanged(field, x);
    for (std::uint32_t p = 0; p < parts; ++p)
    {
        if (contact && p % 2 == 0)
            continue;
        std::array<long double, 3> lack{};
        double whole = 0, terms = 0;
        for (std::uint32_t k = start[p]; k < start[p + 1]; ++k)
        {
            const std::uint32_t v = member[k];
            const double m = 1 / double(position[v].w);
            whole += m;
            for (std::uint32_t j = 0; j < 3; ++j)
            {
                const double far = kLift * double(predicted[v][int(j)]),
                             near = kLift * double(delta[v][int(j)]);
                const double old = double(x[3 * v + j]);
                lack[j] += m * (far - near - old);
                terms = terms + m * (std::abs(far) + std::abs(near) + std::abs(old));
            }
        }
        for (std::uint32_t k = start[p]; k < start[p + 1]; ++k)
            for (std::uint32_t j = 0; j < 3; ++j)
            {
                const std::size_t at = 3 * member[k] + j;
                field.value[at] += double(lack[j]) / whole;
                field.scale[at] = std::abs(double(x[at])) + terms / whole;
            }
    }
    check_on_every_device(c);
}

TEST_CASE("implicit_momentum leaves a part alone whose sums are not finite")
{
    std::vector<glm::vec4> still(4, glm::vec4(0, 0, 0, 1)), far = still;
    far[1].x = std::numeric_limits<float>::infinity();
    const std::vector<float> x = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    Case c;
    c.in = {{"position", bytes_of(still)},
            {"delta", bytes_of(still)},
            {"predicted", bytes_of(far)},
            {"x", bytes_of(x)},
            {"start", bytes_of(std::vector<std::uint32_t>{0, 4})},
            {"member", bytes_of(std::vector<std::uint32_t>{0, 1, 2, 3})}};
    c.launches = {make_launch(kernels::implicit_momentum::info("", c.precision),
                              kernels::implicit_momentum::Params{1, 64}, 1)};
    add_unchanged(c.expected["x"], x);
    check_on_every_device(c);
}
