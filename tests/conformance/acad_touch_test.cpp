#include "taut/kernels/acad_touch.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEST_CASE("acad_touch finds the vertices that are ends of constraints and counts them")
{
    const Dealt dealt = GENERATE(from_range(small_deals()));
    CAPTURE(dealt.count, dealt.groups);
    Random random(100 + dealt.count);
    const RowNet<float> net =
        random_row_net<float>(random, 2 * dealt.count); // one vertex more than the count
    const std::vector<std::uint32_t> flags = random_flags(random, net.rows(), 0.2, true);
    Case c;
    std::vector<std::uint32_t> touched(net.vertices(), 77), sums(2 * dealt.groups, 77);
    c.in = {{"start", bytes_of(net.start)},
            {"incident", bytes_of(net.incident)},
            {"flags", bytes_of(flags)},
            {"touched", bytes_of(touched)},
            {"sums", bytes_of(sums)}};
    c.launches = {make_launch(kernels::acad_touch::info("", c.precision),
                              kernels::acad_touch::Params{dealt.count, dealt.chunk(), dealt.groups},
                              dealt.dispatched())};
    std::fill(sums.begin() + dealt.groups, sums.end(), 0u);
    for (std::uint32_t v = 0; v < dealt.count; ++v)
    {
        bool any = false;
        for (std::uint32_t k = net.start[v]; k < net.start[v + 1]; ++k)
            any = any || flags[net.incident[k] / 2] % 2 == 1;
        touched[v] = any ? TAUT_ACAD_ROW : TAUT_ACAD_SPRING;
        sums[dealt.groups + dealt.group_of(v)] += any ? 1 : 0;
    }
    look_on_every_device(c, [&](const Buffers& out) {
        check_words(out, "touched", touched);
        check_words(out, "sums", sums);
    });
}
