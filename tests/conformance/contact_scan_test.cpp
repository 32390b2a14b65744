#include "taut/kernels/contact_scan.hpp"

#include "support/contact_net.hpp"

#include <numeric>
#include <string>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("contact_scan says where rows begin, and what passes over pairs take", "", float, double)
{
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u, 20000u);
    const std::string variant = GENERATE("", "rows", "guarded_rows");
    const bool rows = !variant.empty(), guarded = variant == "guarded_rows", cut = GENERATE(false, true);
    CAPTURE(count, variant, cut);
    Random random(2400 + count);
    std::vector<std::uint32_t> found, compared, start = {0};
    for (std::uint32_t k = 0; k < count; ++k)
    {
        found.push_back(random.below(5) * random.below(40));
        compared.push_back(random.below(100));
        start.push_back(start.back() + found.back());
    }
    const std::uint32_t total = start.back(), vertices = 130;
    const std::uint32_t capacity = GENERATE(0u, 1u << 24); // one that holds some, one that holds all
    const std::uint32_t holds = capacity == 0 ? total / 2 : capacity;
    auto control = control_of(3);
    control.resize(TAUT_CONTACT_WORDS, 0);
    control[TAUT_CONTACT_MISSING] = 5;
    control[TAUT_CONTACT_CUT_SEEN] = cut ? 1 : 4;
    Case c;
    c.precision = precision_of<TestType>();
    c.in = {{"found", bytes_of(found)},
            {"start", bytes_of(std::vector<std::uint32_t>(count + 1, 9))},
            {"compared", bytes_of(compared)},
            {"control", bytes_of(control)},
            {"lost", bytes_of(std::vector<std::uint32_t>(TAUT_CONTACT_GUARDED_LOST_WORDS, 4))}};
    // One group more than needed: on some devices counts are rounded up.
    c.launches = {make_launch(kernels::contact_scan::info(variant, c.precision),
                              kernels::contact_scan::Params{count, holds, vertices}, 2)};
    if (!rows)
    {
        c.in.erase("compared");
        c.in.erase("control");
    }
    if (!guarded)
        c.in.erase("lost");
    const std::uint32_t listed = std::min(total, holds);
    control[TAUT_CONTACT_PAIR_GROUPS] = (listed + 63) / 64;
    control[TAUT_CONTACT_VERTEX_GROUPS] = listed > 0 ? 3 : 0;
    control[TAUT_CONTACT_LISTED] = listed;
    control[TAUT_CONTACT_FOUND] = total;
    control[TAUT_CONTACT_COMPARED] = std::accumulate(compared.begin(), compared.end(), 0u);
    control[TAUT_CONTACT_MISSING] += total - listed;
    control[TAUT_CONTACT_GATE_PAIRS] = control[TAUT_CONTACT_PAIR_GROUPS];
    if (guarded)
    {
        control[TAUT_CONTACT_HOLDS] = total > listed || cut ? 1 : 0; // something was left out
        control[TAUT_CONTACT_CUT_SEEN] = 4;
    }
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(words_of(out, "start") == start);
        if (rows)
            CHECK(words_of(out, "control") == control);
    });
}
