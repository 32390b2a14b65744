#include "taut/kernels/cg_step.hpp"

#include "support/cg_cases.hpp"

#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

/// Rows and groups as small as a decision needs.
template <typename Real>
Case small_case(const CgState<Real>& before, const std::vector<Real>& curvatures)
{
    Random random(4);
    const std::uint32_t count = 200;
    const auto r = random_reals<Real>(random, count), q = random_reals<Real>(random, count);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"residual", bytes_of(r)},
            {"product", bytes_of(q)},
            {"curvatures", bytes_of(curvatures)},
            {"partials", bytes_of(std::vector<Real>(4, Real(9)))},
            {"before", bytes_of(std::vector{before})},
            {"after", Bytes(sizeof(before))}};
    c.launches = {
        make_launch(kernels::cg_step::info("", c.precision), kernels::cg_step::Params{count, 128, 2}, 2)};
    return c;
}

} // namespace

TEMPLATE_TEST_CASE("cg_step goes along q and leaves the partial sums of the new residual", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "diagonal", "block", "stored", "stored_held");
    for (const Dealt& dealt : deals())
    {
        CAPTURE(variant, dealt.count, dealt.groups);
        Random random(50 + dealt.count);
        const Preconditioned<Real> m(variant, dealt.count, random);
        auto r = random_reals<Real>(random, m.rows + 7), q = random_reals<Real>(random, m.rows + 7);
        for (std::uint32_t row = 0; row < m.rows; ++row)
            if (m.held(row))
            {
                r[row] = 0;
                q[row] = std::numeric_limits<Real>::quiet_NaN(); // of no interest
            }
        const auto curvatures = random_reals<Real>(random, dealt.groups, 0.5, 1);
        const CgState<Real> before = middle_of_solve<Real>();
        Case c;
        c.precision = precision_of<Real>();
        c.in = {{"residual", bytes_of(r)},
                {"product", bytes_of(q)},
                {"curvatures", bytes_of(curvatures)},
                {"partials", bytes_of(std::vector<Real>(2 * dealt.groups, Real(9)))},
                {"before", bytes_of(std::vector{before})},
                {"after", Bytes(sizeof(before))},
                {"inverse", bytes_of(m.inverse)}};
        c.launches = {make_launch(kernels::cg_step::info(variant, c.precision),
                                  kernels::cg_step::Params{dealt.count, dealt.chunk(), dealt.groups},
                                  dealt.dispatched())};
        double curvature = 0;
        for (const Real term : curvatures)
            curvature += double(term);
        const double alpha = double(before.rz) / curvature;
        std::vector<double> next(m.rows), size(m.rows);
        Field& residual = c.expected["residual"];
        for (std::uint32_t row = 0; row < m.rows; ++row)
        {
            next[row] = m.held(row) ? 0 : double(r[row]) - alpha * double(q[row]);
            size[row] = m.held(row) ? 0 : std::abs(double(r[row])) + alpha * std::abs(double(q[row]));
            residual.add(next[row], size[row]);
        }
        add_unchanged(residual, r, m.rows);
        GroupSums rz(dealt), rr(dealt);
        for (std::uint32_t row = 0; row < m.rows; ++row)
        {
            const std::uint32_t unit = variant == "block" ? row / 3 : row;
            double z = 0, z_size = 0, unused = 0;
            m.apply(next, row, z, unused);
            m.apply(size, row, unused, z_size); // not below: magnitudes of residuals times those of M^-1
            rz.add(unit, next[row] * z, size[row] * z_size);
            rr.add(unit, next[row] * next[row], size[row] * size[row]);
        }
        Field& partials = c.expected["partials"];
        if (variant.starts_with("stored")) // comes from the preconditioner's own passes
            for (std::uint32_t g = 0; g < dealt.groups; ++g)
                partials.add(9, 0);
        else
            rz.put(partials);
        rr.put(partials);
        look_on_every_device(c, [&](const Buffers& out) {
            const CgState<Real> after = state_after<Real>(out);
            CHECK(double(after.step) == near<Real>(alpha));
            CHECK(double(after.curvature) == near<Real>(curvature));
            CHECK(after.status == TAUT_CG_RUNNING);
            CHECK(after.exhausted == 0);
            CHECK(double(after.steepest) == near<Real>(std::max(double(before.steepest), curvature / 3)));
            CHECK((after.rz == before.rz && after.iteration == before.iteration && after.pmp == before.pmp));
        });
    }
}

TEMPLATE_TEST_CASE("cg_step tells curvatures of a definite matrix, of an indefinite one and of rounding", "",
                   float, double)
{
    using Real = TestType;
    const Real infinity = std::numeric_limits<Real>::infinity();
    const CgState<Real> before = middle_of_solve<Real>();
    const double doubt = double(before.epsilon) * double(before.steepest) * double(before.pmp);
    struct Expected
    {
        double curvature;
        std::uint32_t status, exhausted;
    };
    const Expected expected = GENERATE_COPY(values<Expected>({
        {1.5, TAUT_CG_RUNNING, 0},
        {2 * doubt, TAUT_CG_RUNNING, 0},
        {0.5 * doubt, TAUT_CG_RUNNING, 1}, // positive, but it may be rounding
        {0, TAUT_CG_RUNNING, 1},
        {-0.5 * doubt, TAUT_CG_RUNNING, 1},
        {-200 * doubt, TAUT_CG_RUNNING, 1}, // negative, but it may be rounding
        {-300 * doubt, TAUT_CG_INDEFINITE_MATRIX, 0},
        {-1.5, TAUT_CG_INDEFINITE_MATRIX, 0},
        {double(infinity), TAUT_CG_NON_FINITE, 0},
        {-double(infinity), TAUT_CG_NON_FINITE, 0},
        {double(std::numeric_limits<Real>::quiet_NaN()), TAUT_CG_NON_FINITE, 0},
    }));
    CAPTURE(expected.curvature, doubt);
    Case c = small_case<Real>(before, {Real(expected.curvature), Real(0)});
    const bool moves = expected.status == TAUT_CG_RUNNING && expected.exhausted == 0;
    if (!moves)
        add_unchanged(c.expected["residual"], values_of<Real>(c.in["residual"]));
    look_on_every_device(
        c,
        [&](const Buffers& out) {
            const CgState<Real> after = state_after<Real>(out);
            CHECK(after.status == expected.status);
            CHECK(after.exhausted == expected.exhausted);
            CHECK((after.step != 0) == moves);
            if (moves)
                CHECK(double(after.step) == near<Real>(2 / expected.curvature));
        },
        std::isfinite(expected.curvature));
}

TEMPLATE_TEST_CASE("cg_step takes no step that overflows", "", float, double)
{
    using Real = TestType;
    CgState<Real> before = middle_of_solve<Real>();
    before.rz = std::numeric_limits<Real>::max();
    before.steepest = 0; // nothing to compare with yet: the curvature in hand is the steepest
    Case c = small_case<Real>(before, {Real(0.25), Real(0)});
    add_unchanged(c.expected["residual"], values_of<Real>(c.in["residual"]));
    look_on_every_device(c, [&](const Buffers& out) {
        CHECK(state_after<Real>(out).step == 0);
        CHECK(state_after<Real>(out).exhausted == 1);
        CHECK(state_after<Real>(out).status == TAUT_CG_RUNNING);
    });
}

TEMPLATE_TEST_CASE("cg_step of a residual that is not finite says so in its sums", "", float, double)
{
    using Real = TestType;
    Case c = small_case<Real>(middle_of_solve<Real>(), {Real(1), Real(1)});
    auto q = values_of<Real>(c.in["product"]);
    q[150] = GENERATE(std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity());
    c.in["product"] = bytes_of(q);
    look_on_every_device(
        c,
        [&](const Buffers& out) {
            const auto partials = values_of<Real>(out.at("partials"));
            CHECK((std::isfinite(partials[0]) && std::isfinite(partials[2])));
            CHECK((!std::isfinite(partials[1]) && !std::isfinite(partials[3])));
        },
        false);
}
