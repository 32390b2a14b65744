#include "taut/kernels/contact_make.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

double mixed(std::uint32_t rule, double m, double n)
{
    switch (rule)
    {
    case TAUT_CONTACT_MIX_MINIMUM: return std::min(m, n);
    case TAUT_CONTACT_MIX_MAXIMUM: return std::max(m, n);
    case TAUT_CONTACT_MIX_PRODUCT: return m * n;
    case TAUT_CONTACT_MIX_GEOMETRIC_MEAN: return std::sqrt(m * n);
    default: return 0.5 * (m + n);
    }
}

} // namespace

TEMPLATE_TEST_CASE("contact_make gives a pair its side, its gap and its friction, and counts its corners", "",
                   float, double)
{
    using Real = TestType;
    using Vec = glm::vec<4, Real>;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t rule = count == 1000 ? GENERATE(range(0u, 5u)) : TAUT_CONTACT_MIX_MEAN;
    CAPTURE(count, rule);
    Random random(2500 + count);
    const auto net = contact_net<Real>(120, random, 0.003);
    const auto pairs = some_pairs(net, count + 3, random);
    std::vector<Vec> rest;
    for (std::uint32_t v = 0; v < net.position.size(); ++v) // another shape, parts of it nearer than the gap
        rest.emplace_back(glm::vec<3, Real>(net.position[v]) * Real(v % 3 == 0 ? 0.05 : 0.5),
                          Real(v / 12 % 3));
    using Side = layout::ContactSide<Real>;
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pairs)},
            {"position", bytes_of(net.position)},
            {"rest", bytes_of(rest)},
            {"body", bytes_of(net.body)},
            {"control", bytes_of(control_of(count))},
            {"side", bytes_of(std::vector<Real>((count + 3) * sizeof(Side) / sizeof(Real), Real(3)))},
            {"corners", bytes_of(std::vector<std::uint32_t>(net.position.size(), 0))}};
    c.launches = {make_launch(kernels::contact_make::info("", c.precision),
                              kernels::contact_make::Params{count + 3, rule, 1e-7f, 0, 1, 0}, count + 3)};
    std::vector<std::uint32_t> corners(net.position.size(), 0);
    Field& field = c.expected["side"];
    std::size_t thin = 0;
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const auto& p = pairs[k];
        for (const std::uint32_t v : {p.a, p.b, p.c, p.d})
            ++corners[v];
        const auto now = nearest_of(p, [&](std::uint32_t v) { return net.x(v); });
        const auto then = nearest_of(p, [&](std::uint32_t v) { return glm::dvec3(rest[v]); });
        // The way is a difference of places of some metres.
        const double blur = 1 + 4 / now.distance();
        for (int axis = 0; axis < 3; ++axis)
            field.add(now.way[axis] / now.distance(), blur);
        const auto &first = net.body[static_cast<std::size_t>(rest[p.a].w)],
                   &second = net.body[static_cast<std::size_t>(rest[p.d].w)];
        const double sum = static_cast<double>(first.radius) + static_cast<double>(second.radius);
        const bool same = rest[p.a].w == rest[p.d].w;
        const double gap = same ? std::min(sum, 0.9999 * then.distance()) : sum;
        thin += gap < sum ? 1 : 0;
        field.add(gap, 1);
        field.add(gap, 1);
        field.add(mixed(rule, static_cast<double>(first.friction), static_cast<double>(second.friction)), 1);
        for (int nothing = 0; nothing < 10; ++nothing) // it has not slipped
            field.add(0, 0);
    }
    for (int k = 0; k < 3 * 16; ++k)
        field.add(3, 0);
    CHECK((count < 1000 || thin > 0));
    look_on_every_device(c, [&](const Buffers& out) { CHECK(words_of(out, "corners") == corners); });
}

TEST_CASE("contact_make puts the higher of two that touch on top, and takes no side that is no number")
{
    using Vec = glm::vec<4, float>;
    const bool higher = GENERATE(true, false);
    const float up = GENERATE(1.0f, -1.0f), level = GENERATE(0.0f, 3.0f);
    CAPTURE(higher, up, level);
    std::vector<Vec> position = {{0.25f, 0, 0.25f, 1}, {0, 0, 0, 1},
                                 {1, 0, 0, 1},         {0, 0, 1, 1},
                                 {0, 0, 0, 1},         {0.25f, 1e-17f, 0.25f, 1},
                                 {0.25f, 0, 0.25f, 1}, {0.25f, -1e-5f, 0.25f, 1}};
    for (Vec& x : position)
        x.y += level;
    position[6].y = std::nextafter(position[6].y, 9.0f); // as rounding leaves it
    // Vertices in the triangle, one on a triangle without area, edges on top of each other; and a vertex
    // that is below.
    const std::vector<layout::ContactPair<float>> pairs = {
        {0, 1, 2, 3, TAUT_CONTACT_VERTEX}, {0, 2, 1, 3, TAUT_CONTACT_VERTEX},
        {5, 1, 2, 3, TAUT_CONTACT_VERTEX}, {6, 1, 2, 3, TAUT_CONTACT_VERTEX},
        {4, 1, 1, 1, TAUT_CONTACT_VERTEX}, {4, 2, 1, 2, TAUT_CONTACT_EDGES},
        {7, 1, 2, 3, TAUT_CONTACT_VERTEX}};
    const std::uint32_t count = static_cast<std::uint32_t>(pairs.size());
    std::vector<Vec> rest = position;
    for (std::size_t v = 0; v < rest.size(); ++v)
        rest[v].w = v == 0 || v >= 4 ? 0 : 1; // the first of each pair is of the first body
    const std::vector<layout::ContactBody<float>> body = {{0.01f, 0, 1, 1, ~0u, higher ? 2u : 0u},
                                                          {0.01f, 0, 1, 1, ~0u, 1}};
    Case c;
    c.in = {{"pair", bytes_of(pairs)},
            {"position", bytes_of(position)},
            {"rest", bytes_of(rest)},
            {"body", bytes_of(body)},
            {"control", bytes_of(control_of(count))},
            {"side", bytes_of(std::vector<layout::ContactSide<float>>(count))},
            {"corners", bytes_of(std::vector<std::uint32_t>(position.size(), 0))}};
    c.launches = {make_launch(kernels::contact_make::info("", Precision::float32),
                              kernels::contact_make::Params{count, TAUT_CONTACT_MIX_MEAN, 0x1p-22f, 0, up, 0},
                              count)};
    look_on_every_device(c, [&](const Buffers& out) {
        const auto sides = values_of<layout::ContactSide<float>>(out.at("side"));
        for (std::uint32_t k = 0; k < count; ++k)
        {
            CAPTURE(k);
            CHECK(std::abs(sides[k].normal_x) < 1e-6f);
            CHECK(sides[k].normal_y == (k + 1 == count ? -1 : higher ? up : -up));
            CHECK(std::abs(sides[k].normal_z) < 1e-6f);
        }
    });
}
