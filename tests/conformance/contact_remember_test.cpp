#include "taut/kernels/contact_remember.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_remember keeps pairs, and the last two rows of their sides, in their places", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(3300 + count);
    const auto net = contact_net<Real>(60, random, 0);
    const auto pairs = unlike_pairs(net, count, random);
    const CornerLists lists(pairs, net.position.size());
    const auto vertices = static_cast<std::uint32_t>(net.position.size());
    std::vector<Real> side, memory;
    for (std::size_t k = 0; k < 16 * pairs.size(); ++k)
    {
        side.push_back(random.uniform<Real>(-1, 1));
        if (k % 16 >= 8)
            memory.push_back(side.back());
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(lists.start)},
            {"corner", bytes_of(lists.corner)},
            {"pair", bytes_of(pairs)},
            {"side", bytes_of(side)},
            {"known", bytes_of(std::vector<layout::ContactPair<Real>>(pairs.size()))},
            {"memory", bytes_of(std::vector<Real>(memory.size(), Real(3)))}};
    c.launches = {make_launch(kernels::contact_remember::info("", c.precision),
                              kernels::contact_remember::Params{vertices}, vertices)};
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(out.at("memory") == bytes_of(memory));
        CHECK(out.at("known") == bytes_of(pairs));
    });
}
