#include "taut/kernels/contact_corners.hpp"

#include "support/contact_net.hpp"

#include "taut/kernels/contact_sort.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_corners and contact_sort list the corners of pairs at each vertex in order", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(2600 + count);
    const auto net = contact_net<Real>(60, random, 0);
    const auto pairs = some_pairs(net, count + 2, random);
    const auto vertices = static_cast<std::uint32_t>(net.position.size());
    auto [start, corner] = CornerLists(std::vector(pairs.begin(), pairs.begin() + count), vertices);
    const std::vector<std::uint32_t> none(vertices, 0);
    std::vector<std::uint32_t> unset(corner.size() + 8, 9);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(pairs)},
            {"control", bytes_of(control_of(count))},
            {"start", bytes_of(start)},
            {"corner", bytes_of(unset)},
            {"taken", bytes_of(none)},
            {"corners", bytes_of(std::vector<std::uint32_t>(vertices, 4))},
            {"lost", bytes_of(std::vector<std::uint32_t>(2, 0))}};
    c.launches = {make_launch(kernels::contact_corners::info("", c.precision),
                              kernels::contact_corners::Params{count + 2}, count + 2),
                  make_launch(kernels::contact_sort::info("", c.precision),
                              kernels::contact_sort::Params{vertices}, vertices)};
    corner.resize(corner.size() + 8, 9);
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(words_of(out, "corner") == corner);
        CHECK(words_of(out, "taken") == none);
        CHECK(words_of(out, "corners") == none);
    });
}
