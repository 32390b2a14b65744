#include "taut/kernels/contact_recall.hpp"

#include "support/contact_net.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_recall finds what is known of a pair, wherever it stood in the old list", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    CAPTURE(count);
    Random random(3400 + count);
    const auto net = contact_net<Real>(60, random, 0);
    const auto old = unlike_pairs(net, count, random);
    std::vector<layout::ContactPair<Real>> now(old.rbegin(), old.rend());
    const std::size_t pairs = old.size(), unknown = pairs / 3;
    for (std::size_t k = 0; k < unknown; ++k) // another corner, or the other kind
        if (k % 2 == 0)
            now[k].d = now[k].a;
        else
            now[k].kind = 7;
    std::vector<Real> memory, side(16 * (pairs + 2), Real(5));
    for (std::size_t k = 0; k < 8 * pairs; ++k)
        memory.push_back(random.uniform<Real>(-1, 1));
    const CornerLists lists(old, net.position.size());
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"pair", bytes_of(now)},
            {"control", bytes_of(control_of(static_cast<std::uint32_t>(pairs)))},
            {"start", bytes_of(lists.start)},
            {"corner", bytes_of(lists.corner)},
            {"known", bytes_of(old)},
            {"memory", bytes_of(memory)},
            {"side", bytes_of(side)}};
    const auto capacity = static_cast<std::uint32_t>(pairs + 2);
    c.launches = {make_launch(kernels::contact_recall::info("", c.precision),
                              kernels::contact_recall::Params{capacity}, capacity)};
    for (std::size_t k = unknown; k < pairs; ++k)
        for (std::size_t j = 0; j < 8; ++j)
            side[16 * k + 8 + j] = memory[8 * (pairs - 1 - k) + j];
    look_on_every_device(c, [&](const Buffers& out) { CHECK(out.at("side") == bytes_of(side)); });
}
