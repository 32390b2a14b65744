#include "taut/kernels/contact_wake.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("contact_wake opens the gates of a search where a vertex strays, else shuts them")
{
    const bool open = GENERATE(false, true);
    CAPTURE(open);
    std::vector<std::uint32_t> control(TAUT_CONTACT_WORDS, 1), lost(TAUT_CONTACT_LOST_WORDS, 7);
    control[TAUT_CONTACT_STRAYED_SEEN] = open ? 6 : 7;
    control[TAUT_CONTACT_GATE_PAIRS] = 30;
    auto expected = control;
    expected[TAUT_CONTACT_STRAYED_SEEN] = 7;
    expected[TAUT_CONTACT_SEARCHED] += open ? 1 : 0;
    expected[TAUT_CONTACT_SINCE] = open ? 1 : 2;
    expected[TAUT_CONTACT_GATE_TRIANGLES] = open ? 20 : 0;
    expected[TAUT_CONTACT_GATE_VERTICES] = open ? 30 : 0;
    expected[TAUT_CONTACT_GATE_ONE] = open ? 1 : 0;
    expected[TAUT_CONTACT_GATE_PAIRS] = 0;
    for (std::uint32_t level = 0; level < TAUT_CONTACT_MOST_LEVELS; ++level)
        expected[TAUT_CONTACT_GATE_LEVELS + 4 * level] = open ? 40 + level : 0;
    Case c;
    c.in = {{"lost", bytes_of(lost)}, {"control", bytes_of(control)}};
    c.launches = {make_launch(kernels::contact_wake::info("", c.precision),
                              kernels::contact_wake::Params{1, 20, 30, 40, 41, 42, 43}, 1)};
    look_on_every_device(c, [&](const Buffers& out) { CHECK(words_of(out, "control") == expected); });
}
