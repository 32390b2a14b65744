#include "taut/kernels/acad_store.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("acad_store gives multipliers to their springs and releases rows that the spring holds",
                   "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const std::uint32_t further = GENERATE(0u, 1u), last = GENERATE(0u, 1u), release = GENERATE(0u, 1u);
    const bool total = further != 0, nothing = GENERATE(false, true);
    CAPTURE(dealt.count, dealt.groups, further, last, release, nothing);
    Random random(140 + dealt.count);
    const std::vector<Real> x = random_reals<Real>(random, dealt.count + 2);
    std::vector<Real> multiplier = random_reals<Real>(random, dealt.count + 2);
    for (std::size_t s = 0; s < multiplier.size(); s += 3)
        multiplier[s] = 0; // no constraint before
    const std::vector<Real> so_far = random_reals<Real>(random, dealt.count + 2);
    const std::vector<Real> hold = random_reals<Real>(random, dealt.count + 2, -400000, 400000);
    std::vector<std::uint32_t> flags(dealt.count + 2, TAUT_ACAD_ROW);
    for (std::size_t s = 0; s < flags.size(); s += 2)
        flags[s] = TAUT_ACAD_PRESSED;
    const std::uint32_t rows = dealt.count * 3 / 4 + 1;
    std::vector<std::uint32_t> list = {std::min(rows, dealt.count)};
    for (const std::uint32_t s : random.shuffled(dealt.count))
        list.push_back(2 * s + (flags[s] == TAUT_ACAD_PRESSED ? 1 : 0));
    layout::CgState<Real> state{};
    state.status = nothing ? TAUT_CG_ZERO_RIGHT_HAND_SIDE : TAUT_CG_CONVERGED;
    layout::StepValues<Real> step{};
    step.substep = Real(1) / Real(600);

    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row_list", bytes_of(list)},
            {"x", bytes_of(x)},
            {"multiplier", bytes_of(multiplier)},
            {"flags", bytes_of(flags)},
            {"hold", bytes_of(hold)},
            {"state", bytes_of(std::vector{state})},
            {"step_values", bytes_of(std::vector{step})},
            {"total", bytes_of(so_far)}};
    c.launches = {make_launch(kernels::acad_store::info(total ? "total" : "", c.precision),
                              kernels::acad_store::Params{dealt.count, dealt.chunk(), further, last, release},
                              dealt.dispatched())};
    std::vector<double> found(x.begin(), x.end()), kept(multiplier.begin(), multiplier.end()),
        size(kept.size(), 0);
    std::vector<double> rows_total(so_far.begin(), so_far.end()), rows_size(x.size(), 0);
    const double h = static_cast<double>(step.substep);
    for (std::uint32_t r = 0; r < list[0]; ++r)
    {
        const std::uint32_t s = list[r + 1] / 2;
        const double side = list[r + 1] % 2 == 1 ? -1 : 1;
        found[r] = nothing ? 0 : found[r];
        rows_size[r] = further != 0 ? std::abs(rows_total[r]) + std::abs(found[r]) : 0;
        rows_total[r] = found[r] + (further != 0 ? rows_total[r] : 0);
        if (last == 0)
            continue;
        const double before = kept[s], limit = 2 * static_cast<double>(hold[s]) * (h * h);
        kept[s] = rows_total[r];
        size[s] = rows_size[r];
        // Which side of the limit must not be a matter of rounding.
        REQUIRE(std::abs(side * (kept[s] + before) - limit) > 1e-6);
        if (release != 0 && multiplier[s] != Real(0) && side * (kept[s] + before) < limit)
            flags[s] = TAUT_ACAD_RELEASED;
    }
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        c.expected["x"].add(found[i], 0);
        c.expected["multiplier"].add(kept[i], size[i]);
        if (total)
            c.expected["total"].add(rows_total[i], rows_size[i]);
    }
    look_on_every_device(c, [&](const Buffers& out) { check_words(out, "flags", flags); });
}
