#include "taut/kernels/acad_flag.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("acad_flag finds the springs beyond their threshold and counts them", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(small_deals()));
    const bool by_strain = GENERATE(false, true), compress = GENERATE(false, true);
    CAPTURE(dealt.count, dealt.groups, by_strain, compress);
    Random random(90 + dealt.count);
    RowNet<Real> net = random_row_net<Real>(random, dealt.count + 3);
    std::vector<std::uint32_t> flags = random_flags(random, net.rows(), 0.4, compress);
    const std::vector<Real> multiplier = random_reals<Real>(random, net.rows(), 1, 2);
    std::vector<typename RowNet<Real>::Vec> low(net.vertices(), {0, 0, 0, 0});
    for (auto& lost : low)
        lost = random.vec4<Real>(1e-8, Real(1e-3));
    const double activate = 0.05, release = by_strain ? 0.02 : -1;
    // Lengths around all thresholds, none nearer than rounding could tell; two that have no length.
    for (std::uint32_t r = 0; r < net.rows(); ++r)
    {
        auto& s = net.row[r];
        const double length = glm::length(wide3(net.position[s.a]) - wide3(net.position[s.b]));
        s.rest_length = static_cast<Real>(length / (1 + random.uniform(compress ? -0.1 : -0.02, 0.1)));
        s.kind = random.chance(0.8) ? 1 : 0;
        if (r % 20 == 7)
            s.rest_length = 0;
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"spring", bytes_of(net.row)},
            {"position", bytes_of(net.position)},
            {"low", bytes_of(low)},
            {"flags", bytes_of(flags)},
            {"multiplier", bytes_of(multiplier)},
            {"sums", bytes_of(std::vector<std::uint32_t>(dealt.groups + 2, 77))}};
    const float strain = 0.05f, least = static_cast<float>(release);
    c.launches = {
        make_launch(kernels::acad_flag::info("", c.precision),
                    kernels::acad_flag::Params{dealt.count, dealt.chunk(), dealt.groups, strain,
                                               static_cast<float>(activate - double(strain)), least,
                                               static_cast<float>(release - double(least)), compress},
                    dealt.dispatched())};
    std::vector<std::uint32_t> sums(dealt.groups + 2, 77);
    std::fill(sums.begin(), sums.end() - 2, 0u);
    for (std::uint32_t r = 0; r < net.rows(); ++r)
    {
        const auto& s = net.row[r];
        const double length = glm::length(wide3(net.position[s.a]) - wide3(net.position[s.b]));
        const double rest = static_cast<double>(s.rest_length), stretch = rest > 0 ? length / rest - 1 : 9;
        // The thresholds are not what is tested.
        REQUIRE((rest == 0 || std::abs(std::abs(stretch) - activate) > 1e-6));
        const std::uint32_t was = flags[r];
        const bool may = s.kind == 1 && rest > 0;
        std::uint32_t now = may && stretch > activate ? TAUT_ACAD_ROW : TAUT_ACAD_SPRING;
        if (compress && may && stretch < -activate)
            now = TAUT_ACAD_PRESSED;
        if ((was == TAUT_ACAD_ROW && stretch >= release) || (was == TAUT_ACAD_PRESSED && stretch <= -release))
            now = was;
        if (r < dealt.count)
        {
            flags[r] = now;
            sums[dealt.group_of(r)] += now != TAUT_ACAD_SPRING ? 1 : 0;
        }
        const bool kept = r >= dealt.count || (was == now && now != TAUT_ACAD_SPRING);
        c.expected["multiplier"].add(kept ? static_cast<double>(multiplier[r]) : 0, 0);
    }
    look_on_every_device(c, [&](const Buffers& out) {
        check_words(out, "flags", flags);
        check_words(out, "sums", sums);
    });
}
