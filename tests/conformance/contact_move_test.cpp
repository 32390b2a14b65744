#include "taut/kernels/contact_move.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_move adds the impulses of a vertex' pairs by their weights, over its mass", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 1000u);
    CAPTURE(count);
    Random random(3000 + count);
    const std::uint32_t pairs = count + 7;
    auto position = random.vec4s<Real>(count + 2, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    const auto delta = random.vec4s<Real>(count + 2, 0.1, 0, 1);
    const auto row = random.vec4s<Real>(2 * pairs, 1, -1, 1), impulse = random.vec4s<Real>(pairs, 0.01, 5, 5);
    std::vector<std::uint32_t> start = {0}, corner, acting(count + 2, 8);
    for (std::uint32_t v = 0; v < count; ++v)
    {
        const std::uint32_t size = v == 0   ? TAUT_CONTACT_CROWD + 1
                                   : v == 1 ? TAUT_CONTACT_CROWD
                                            : random.below(12);
        for (std::uint32_t k = 0; k < size; ++k)
            corner.push_back(random.below(4 * pairs));
        start.push_back(static_cast<std::uint32_t>(corner.size()));
        if (v > 1 && random.chance(0.2))
            acting[v] = 0; // then no impulse is looked at
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},     {"corner", bytes_of(corner)},     {"row", bytes_of(row)},
            {"impulse", bytes_of(impulse)}, {"position", bytes_of(position)}, {"delta", bytes_of(delta)},
            {"acting", bytes_of(acting)}};
    c.launches = {make_launch(kernels::contact_move::info("", c.precision),
                              kernels::contact_move::Params{count}, count)};
    Field& field = c.expected["delta"];
    for (std::uint32_t v = 0; v < count + 2; ++v)
    {
        glm::dvec3 sum(0), size(0);
        // Else nothing moves it.
        const bool acts = v < count && start[v + 1] - start[v] <= TAUT_CONTACT_CROWD && acting[v] > 0;
        for (std::uint32_t k = acts ? start[v] : 0; acts && k < start[v + 1]; ++k)
        {
            const std::uint32_t p = corner[k] / 4;
            const glm::dvec3 part =
                glm::dvec3(impulse[p]) * static_cast<double>(row[2 * p][static_cast<int>(corner[k] % 4)]);
            sum += part;
            size += glm::abs(part);
        }
        const double w = static_cast<double>(position[v].w);
        for (int axis = 0; axis < 3; ++axis)
        {
            const double was = static_cast<double>(delta[v][axis]);
            field.add(was + w * sum[axis], acts && w > 0 ? std::abs(was) + w * size[axis] : 0);
        }
        field.add(static_cast<double>(delta[v].w), 0);
        acting[v] = v < count ? 0 : 8;
    }
    look_on_every_device(c, [&](const Buffers& out) { CHECK(words_of(out, "acting") == acting); });
}
