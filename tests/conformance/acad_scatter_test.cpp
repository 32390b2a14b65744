#include "taut/kernels/acad_scatter.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("acad_scatter puts what carries the flag side by side in its own order")
{
    const Dealt dealt = GENERATE(from_range(deals()));
    const bool place = GENERATE(false, true);
    const double share = GENERATE(0.0, 0.3, 1.0);
    CAPTURE(dealt.count, dealt.groups, place, share);
    Random random(120 + dealt.count);
    const std::vector<std::uint32_t> flags = random_flags(random, dealt.count + 3, share, true);
    std::vector<std::uint32_t> sums(2 * dealt.groups, 77), list(dealt.count + 1, 77);
    std::vector<std::uint32_t> places(dealt.count + 3, 77);
    const std::uint32_t first = place ? 0 : dealt.groups;
    std::vector<std::uint32_t> expected = list, where = places;
    std::uint32_t at = 0;
    for (std::uint32_t i = 0; i < dealt.count; ++i)
    {
        if (i % dealt.chunk() == 0)
            sums[first + i / dealt.chunk()] = at;
        const bool pressed = flags[i] == TAUT_ACAD_PRESSED, row = pressed || flags[i] == TAUT_ACAD_ROW;
        where[i] = row ? at : TAUT_NO_ROW;
        if (row)
            expected[1 + at++] = place ? 2 * i + pressed : i;
    }
    Case c;
    c.in = {{"flags", bytes_of(flags)},
            {"sums", bytes_of(sums)},
            {"list", bytes_of(list)},
            {"place", bytes_of(places)}};
    c.launches = {make_launch(kernels::acad_scatter::info(place ? "place" : "", c.precision),
                              kernels::acad_scatter::Params{dealt.count, dealt.chunk(), first, dealt.groups},
                              dealt.dispatched())};
    look_on_every_device(c, [&](const Buffers& out) {
        check_words(out, "list", expected);
        if (place)
            check_words(out, "place", where);
    });
}
