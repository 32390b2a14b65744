#include "taut/kernels/acad_scan.hpp"

#include "support/acad_net.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("acad_scan says where the rows of each group begin and how many groups solve", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t groups = GENERATE(1u, 2u, 63u, 64u, 65u, 127u, 128u, 129u, 256u, 1000u, 1024u);
    const double share = GENERATE(0.0, 0.3, 1.0);
    CAPTURE(groups, share);
    Random random(110 + groups);
    const std::uint32_t chunk = 128, count = groups * chunk - (groups > 1 ? 5 : 100);
    std::vector<std::uint32_t> sums;
    for (std::uint32_t g = 0; g < 2 * groups; ++g)
    {
        const std::uint32_t size = std::min(chunk, count - (g % groups) * chunk);
        sums.push_back(share == 1 ? size : static_cast<std::uint32_t>(share * random.uniform(0, 1) * size));
    }
    std::vector<std::uint32_t> begins = sums;
    std::uint32_t total[2] = {0, 0};
    for (std::uint32_t g = 0; g < 2 * groups; ++g)
    {
        begins[g] = total[g / groups];
        total[g / groups] += sums[g];
    }
    const std::uint32_t used = (total[0] + chunk - 1) / chunk;
    const auto full = spring_record<Real>(3, 4, 1, 2, 3, 5);
    std::vector<layout::Spring<Real>> row(count, full);
    std::vector<std::uint32_t> control(TAUT_ACAD_WORDS, 9), solver(12, 9), list(2, 9);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"sums", bytes_of(sums)},
            {"control", bytes_of(control)},
            {"solver_control", bytes_of(solver)},
            {"row_list", bytes_of(list)},
            {"list", bytes_of(list)},
            {"row", bytes_of(row)},
            {"partials", bytes_of(std::vector<Real>(3 * groups + 1, Real(7)))},
            {"curvatures", bytes_of(std::vector<Real>(groups + 1, Real(7)))}};
    // One group more than needed: on some devices counts are rounded up.
    c.launches = {make_launch(kernels::acad_scan::info("", c.precision),
                              kernels::acad_scan::Params{count, chunk, groups}, 2)};
    for (std::uint32_t k = 0; k < 3 * groups + 1; ++k)
        c.expected["partials"].add(k < 3 * groups ? 0 : 7, 0);
    for (std::uint32_t k = 0; k < groups + 1; ++k)
        c.expected["curvatures"].add(k < groups ? 0 : 7, 0);
    for (std::uint32_t r = total[0]; r < std::min(used * chunk, count); ++r)
        row[r] = spring_record<Real>(0, 0, 0, 0, 0, 0);
    control[TAUT_ACAD_SOLVE] = used;
    control[TAUT_ACAD_ONCE] = used > 0 ? 1 : 0;
    control[TAUT_ACAD_ROWS] = total[0];
    control[TAUT_ACAD_VERTICES] = total[1];
    solver[TAUT_CONTROL_GROUPS] = used;
    look_on_every_device(c, [&](const Buffers& out) {
        check_words(out, "sums", begins);
        check_words(out, "control", control);
        check_words(out, "solver_control", solver);
        check_words(out, "row_list", {total[0], 9});
        check_words(out, "list", {total[1], 9});
        check_rows(out, "row", row);
    });
}
