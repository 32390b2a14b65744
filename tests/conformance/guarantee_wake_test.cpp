#include "taut/kernels/guarantee_wake.hpp"

#include "support/contact_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("guarantee_wake opens the gates of a search where one is due or a vertex strays, else shuts them")
{
    const bool due = GENERATE(false, true), strays = GENERATE(false, true);
    CAPTURE(due, strays);
    const bool open = due || strays;
    std::vector<std::uint32_t> control(TAUT_CONTACT_GUARDED_WORDS, 1),
        lost(TAUT_CONTACT_GUARDED_LOST_WORDS, 7);
    control[TAUT_CONTACT_STRAYED_SEEN] = strays ? 6 : 7;
    control[TAUT_CONTACT_GATE_PAIRS] = 30;
    auto expected = control;
    expected[TAUT_CONTACT_STRAYED_SEEN] = 7;
    expected[TAUT_CONTACT_SEARCHED] += open ? 1 : 0;
    expected[TAUT_CONTACT_GATE_TRIANGLES] = open ? 20 : 0;
    expected[TAUT_CONTACT_GATE_VERTICES] = open ? 30 : 0;
    expected[TAUT_CONTACT_GATE_ONE] = open ? 1 : 0;
    expected[TAUT_CONTACT_GATE_PAIRS] = 0;
    for (std::uint32_t level = 0; level < TAUT_CONTACT_MOST_LEVELS; ++level)
        expected[TAUT_CONTACT_GATE_LEVELS + 4 * level] = open ? 40 + level : 0;
    Case c;
    c.in = {{"lost", bytes_of(lost)}, {"control", bytes_of(control)}};
    c.launches = {make_launch(kernels::guarantee_wake::info("", c.precision),
                              kernels::guarantee_wake::Params{1, due, 20, 30, 40, 41, 42, 43}, 1)};
    look_on_every_device(c, [&](const Buffers& out) { CHECK(words_of(out, "control") == expected); });
}
