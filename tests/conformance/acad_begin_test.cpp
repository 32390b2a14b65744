#include "taut/kernels/acad_begin.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("acad_begin lets rows be chosen only where a spring asks for it")
{
    const std::uint32_t asked = GENERATE(0u, 1u, 1000u);
    CAPTURE(asked);
    std::vector<std::uint32_t> events(TAUT_EVENT_WORDS, 7), control(TAUT_ACAD_WORDS, 9), flags(6, 5);
    events[TAUT_EVENT_ACAD] = asked;
    Case c;
    c.in = {{"control", bytes_of(control)}, {"flags", bytes_of(flags)}, {"events", bytes_of(events)}};
    c.launches = {
        make_launch(kernels::acad_begin::info("", c.precision), kernels::acad_begin::Params{1, 3, 5}, 1)};
    const bool any = asked > 0;
    flags[5] = any ? 1 : 0;
    control[TAUT_ACAD_CHOOSE] = any ? 3 : 0;
    control[TAUT_ACAD_SCAN] = any ? 1 : 0;
    for (const int word : {TAUT_ACAD_SOLVE, TAUT_ACAD_ONCE, TAUT_ACAD_ROWS, TAUT_ACAD_VERTICES})
        control[static_cast<std::size_t>(word)] = any ? 9 : 0; // else for acad_scan
    events[TAUT_EVENT_ACAD] = 0;
    for (const std::string& selector : test_devices())
    {
        INFO(selector);
        const Buffers out = run(*test_device(selector), c.launches, c.in);
        check_words(out, "control", control);
        check_words(out, "flags", flags);
        check_words(out, "events", events);
        CHECK(test_device(selector)->counters().validation_messages == 0);
    }
}
