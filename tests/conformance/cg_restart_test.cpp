#include "taut/kernels/cg_restart.hpp"
#include "taut/kernels/shared/active_rows.h"

#include "support/cg_cases.hpp"

#include <limits>

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("cg_restart clears held rows, sums the residual and sets the iteration going", "", float,
                   double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "diagonal", "block", "stored", "stored_held");
    const std::uint32_t begin = GENERATE(0u, 1u), stride = GENERATE(1u, 2u);
    for (const Dealt& dealt : deals())
    {
        CAPTURE(variant, begin, stride, dealt.count, dealt.groups);
        Random random(90 + dealt.count);
        const Preconditioned<Real> m(variant, dealt.count, random);
        const auto r = random_reals<Real>(random, m.rows + 7);
        auto b = random_reals<Real>(random, stride * m.rows);
        for (std::size_t i = 1; stride == 2 && i < b.size(); i += 2)
            b[i] = std::numeric_limits<Real>::quiet_NaN(); // a low word, which nobody sums
        CgState<Real> before = middle_of_solve<Real>();
        before.exhausted = 1;
        // Where only some groups hold rows in use, only these go on.
        const std::uint32_t used = dealt.groups > 2 ? 2 : 0;
        std::vector<std::uint32_t> words(TAUT_CONTROL_HISTORY + 4, 77u);
        words[TAUT_CONTROL_GROUPS] = used;
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"residual", bytes_of(r)},
                {"b", bytes_of(b)},
                {"partials", bytes_of(std::vector<Real>(3 * dealt.groups, Real(9)))},
                {"before", bytes_of(std::vector{before})},
                {"after", Bytes(sizeof(before))},
                {"control", bytes_of(words)},
                {"inverse", bytes_of(m.inverse)}};
        const kernels::cg_restart::Params params{dealt.count, dealt.chunk(), dealt.groups, begin, stride};
        c.launches = {
            make_launch(kernels::cg_restart::info(variant, c.precision), params, dealt.dispatched())};
        Field &residual = c.expected["residual"], &partials = c.expected["partials"];
        std::vector<double> left(m.rows), size(m.rows);
        for (std::uint32_t row = 0; row < m.rows; ++row)
        {
            left[row] = m.held(row) ? 0 : double(r[row]);
            size[row] = std::abs(left[row]);
            residual.add(left[row], 0);
        }
        add_unchanged(residual, r, m.rows);
        GroupSums rz(dealt), rr(dealt), bb(dealt);
        for (std::uint32_t row = 0; row < m.rows; ++row)
        {
            const std::uint32_t unit = variant == "block" ? row / 3 : row;
            double z = 0, z_size = 0;
            m.apply(left, row, z, z_size);
            rz.add(unit, left[row] * z, size[row] * z_size);
            rr.add(unit, left[row] * left[row]);
            const double right = m.held(row) ? 0 : double(b[std::size_t{row} * stride]);
            bb.add(unit, right * right);
        }
        const auto nines = [&] {
            for (std::uint32_t g = 0; g < dealt.groups; ++g)
                partials.add(9, 0);
        };
        variant.starts_with("stored") ? nines() : rz.put(partials); // else from its own passes
        rr.put(partials);
        begin == 0 ? nines() : bb.put(partials);
        look_on_every_device(c, [&](const Buffers& out) {
            const CgState<Real> after = state_after<Real>(out);
            CHECK((after.fresh == 1 && after.step == 0 && after.exhausted == 0));
            CHECK(after.replacements == before.replacements + (begin == 0 ? 1u : 0u));
            CHECK((after.rz == before.rz && after.rr == before.rr && after.bb == before.bb));
            CHECK((after.direction == before.direction && after.iteration == before.iteration));
            const std::uint32_t g = used == 0 ? dealt.groups : used;
            const bool open =
                variant.starts_with("stored") && begin == 0; // for the passes of the preconditioner
            const std::vector<std::uint32_t> control = {g,  1,  1,  used, open ? 77u : 0u, 1, 1, 77,
                                                        77, 77, 77, 77};
            CHECK(values_of<std::uint32_t>(out.at("control")) == control);
        });
    }
}
