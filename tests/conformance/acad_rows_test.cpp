#include "taut/kernels/acad_rows.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("acad_rows copies the springs of a list side by side", "", float, double)
{
    using Real = TestType;
    const Dealt dealt = GENERATE(from_range(deals()));
    if (dealt.count > 1000)
        return;
    const double share = GENERATE(0.0, 0.4, 1.0);
    const std::uint32_t further = GENERATE(0u, 1u);
    CAPTURE(dealt.count, dealt.groups, share, further);
    Random random(130 + dealt.count);
    const RowNet<Real> net = random_row_net<Real>(random, dealt.count);
    const std::vector<Real> multiplier = random_reals<Real>(random, dealt.count);
    const std::vector<Real> inverse = random_reals<Real>(random, dealt.count, 1, 2);
    const auto rows = static_cast<std::uint32_t>(share * dealt.count);
    std::vector<std::uint32_t> list = {rows};
    for (const std::uint32_t s : random.shuffled(dealt.count))
        list.push_back(s);
    const auto other = spring_record<Real>(9, 9, 9, 9, 9, 9);
    std::vector<layout::Spring<Real>> row(dealt.count, other);
    std::vector<Real> x(dealt.count, Real(9)), m(dealt.count, Real(9));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row_list", bytes_of(list)},
            {"candidate", bytes_of(net.row)},
            {"candidate_inverse", bytes_of(inverse)},
            {"multiplier", bytes_of(multiplier)},
            {"row", bytes_of(row)},
            {"x", bytes_of(x)},
            {"inverse", bytes_of(m)}};
    c.launches = {make_launch(kernels::acad_rows::info("", c.precision),
                              kernels::acad_rows::Params{dealt.count, dealt.chunk(), further},
                              dealt.dispatched())};
    for (std::uint32_t r = 0; r < rows; ++r)
    {
        row[r] = net.row[list[r + 1]];
        x[r] = further != 0 ? Real(0) : multiplier[list[r + 1]];
        m[r] = inverse[list[r + 1]];
    }
    look_on_every_device(c, [&](const Buffers& out) {
        check_rows(out, "row", row);
        const bool same_values = out.at("x") == bytes_of(x) && out.at("inverse") == bytes_of(m);
        CHECK(same_values);
    });
}
