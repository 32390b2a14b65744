#include "taut/kernels/cg_direction.hpp"
#include "taut/kernels/shared/active_rows.h"

#include "support/cg_cases.hpp"

#include <bit>
#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kHistory = 16;

std::vector<std::uint32_t> fresh_control()
{
    std::vector<std::uint32_t> words(TAUT_CONTROL_HISTORY + kHistory, 77u);
    words[TAUT_CONTROL_GROUPS] = 0; // all of them
    return words;
}

/// Everything but the launch; partials one a group each: r.z, r.r, b.b.
template <typename Real>
Case make_case(const CgState<Real>& before, const std::vector<Real>& residual,
               const std::vector<Real>& direction, const std::vector<Real>& x,
               const std::vector<Real>& partials)
{
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"residual", bytes_of(residual)},
            {"direction", bytes_of(direction)},
            {"x", bytes_of(x)},
            {"partials", bytes_of(partials)},
            {"before", bytes_of(std::vector{before})},
            {"after", Bytes(sizeof(before))},
            {"control", bytes_of(fresh_control())}};
    return c;
}

enum class Then
{
    turn,
    replace,
    end
};

/// A state and sums by hand, and what must be decided.
struct Decision
{
    std::string name;
    std::function<void(CgState<double>&)> change; ///< of middle_of_solve
    double rz, rr, bb;
    Then then;
    std::uint32_t status;
    bool steps = true; ///< x takes the step in hand
    std::uint32_t stalls = 0, direction = TAUT_DIRECTION_CONJUGATE;
    bool last = false;
};

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = 0x1p-39; // rr below the tolerance of middle_of_solve, 2^-40 * 4

void make_fresh(CgState<double>& s)
{
    s.fresh = 1;
    s.step = 0;
}

std::vector<Decision> decisions()
{
    const auto nothing = [](CgState<double>&) {};
    const auto fresh = make_fresh;
    const auto begin = [](CgState<double>& s) {
        make_fresh(s);
        s.begun = 0;
        s.iteration = 0;
        s.bb = s.rr = 0;
        s.direction = TAUT_DIRECTION_NONE;
    };
    const auto at_limit = [](CgState<double>& s) { s.iteration = s.iteration_limit; };
    const auto ended = [](CgState<double>& s) {
        s.status = TAUT_CG_INDEFINITE_MATRIX;
        s.step = 0;
    };
    return {
        {"nothing is wrong", nothing, 1, 0.25, 0, Then::turn, TAUT_CG_RUNNING},
        {"the first iteration", begin, 1, 0.25, 9, Then::turn, TAUT_CG_RUNNING, false, 0,
         TAUT_DIRECTION_STEEPEST},
        {"exact at the start", begin, 0, 0, 9, Then::end, TAUT_CG_CONVERGED, false, 0, TAUT_DIRECTION_NONE},
        {"b = 0", begin, 1, 0.25, 0, Then::end, TAUT_CG_ZERO_RIGHT_HAND_SIDE, false, 0, TAUT_DIRECTION_NONE},
        {"b overflows", begin, 1, 0.25, kInfinity, Then::end, TAUT_CG_NON_FINITE, false, 0,
         TAUT_DIRECTION_NONE},
        {"b is NaN", begin, 1, 0.25, kNan, Then::end, TAUT_CG_NON_FINITE, false, 0, TAUT_DIRECTION_NONE},
        {"small, but by recurrence", nothing, kTiny, kTiny, 0, Then::replace, TAUT_CG_RUNNING},
        {"small and formed anew", fresh, kTiny, kTiny, 0, Then::end, TAUT_CG_CONVERGED, false},
        {"zero by recurrence", nothing, 0, 0, 0, Then::replace, TAUT_CG_RUNNING},
        {"r.r is NaN", nothing, 1, kNan, 0, Then::end, TAUT_CG_NON_FINITE, false},
        {"r.r is infinite", nothing, 1, kInfinity, 0, Then::end, TAUT_CG_NON_FINITE, false},
        {"r.z is NaN", nothing, kNan, 0.25, 0, Then::end, TAUT_CG_NON_FINITE, false},
        {"r.z is infinite", nothing, kInfinity, 0.25, 0, Then::end, TAUT_CG_NON_FINITE, false},
        {"the residual runs away", nothing, 1, 0x1p41, 0, Then::end, TAUT_CG_RAN_AWAY, false},
        {"r.z is negative", nothing, -1, 0.25, 0, Then::end, TAUT_CG_INDEFINITE_PRECONDITIONER},
        {"r.z is zero", nothing, 0, 0.25, 0, Then::end, TAUT_CG_INDEFINITE_PRECONDITIONER},
        {"r.z underflows", begin, 0, 0x1p-97, 0x1p-97, Then::end, TAUT_CG_CONVERGED, false, 0,
         TAUT_DIRECTION_NONE},
        {"r.z underflows by recurrence", [](CgState<double>& s) { s.bb = 0x1p-60; }, 0, 0x1p-99, 0,
         Then::replace, TAUT_CG_RUNNING},
        {"r.z is zero, r.r could be told", begin, 0, 0x1p-95, 0x1p-95, Then::end,
         TAUT_CG_INDEFINITE_PRECONDITIONER, false, 0, TAUT_DIRECTION_NONE},
        {"the limit, by recurrence", at_limit, 1, 0.25, 0, Then::replace, TAUT_CG_RUNNING},
        {"the limit, formed anew", [=](CgState<double>& s) { make_fresh(s), at_limit(s); }, 1, 0.25, 0,
         Then::end, TAUT_CG_ITERATION_LIMIT, false},
        {"converged at the limit", [=](CgState<double>& s) { make_fresh(s), at_limit(s); }, kTiny, kTiny, 0,
         Then::end, TAUT_CG_CONVERGED, false},
        {"no iteration follows, by recurrence", nothing, 1, 0.25, 0, Then::replace, TAUT_CG_RUNNING, true, 0,
         TAUT_DIRECTION_CONJUGATE, true},
        {"no iteration follows, formed anew", fresh, 1, 0.25, 0, Then::end, TAUT_CG_ITERATION_LIMIT, false, 0,
         TAUT_DIRECTION_CONJUGATE, true},
        {"exhausted in a conjugate direction", [](CgState<double>& s) { s.exhausted = 1, s.step = 0; }, 1,
         0.25, 0, Then::replace, TAUT_CG_RUNNING, false, 0, TAUT_DIRECTION_NONE},
        {"after that, steepest descent",
         [](CgState<double>& s) { make_fresh(s), s.direction = TAUT_DIRECTION_NONE; }, 1, 0.25, 0, Then::turn,
         TAUT_CG_RUNNING, false, 0, TAUT_DIRECTION_STEEPEST},
        {"exhausted in steepest descent",
         [](CgState<double>& s) { s.exhausted = 1, s.step = 0, s.direction = TAUT_DIRECTION_STEEPEST; }, 1,
         0.25, 0, Then::end, TAUT_CG_EXHAUSTED, false, 0, TAUT_DIRECTION_NONE},
        {"much smaller than its peak", nothing, 1, 0x1p-12, 0, Then::replace, TAUT_CG_RUNNING},
        {"no new smallest for long", [](CgState<double>& s) { s.waited = 50; }, 1, 0.75, 0, Then::replace,
         TAUT_CG_RUNNING},
        {"a check that finds progress", [=](CgState<double>& s) { make_fresh(s), s.stalls = 2; }, 1, 1, 0,
         Then::turn, TAUT_CG_RUNNING, false, 0},
        {"a check that finds none", [=](CgState<double>& s) { make_fresh(s), s.stalls = 1; }, 1, 3, 0,
         Then::turn, TAUT_CG_RUNNING, false, 2},
        {"the third in a row", [=](CgState<double>& s) { make_fresh(s), s.stalls = 2; }, 1, 3, 0, Then::end,
         TAUT_CG_STALLED, false, 3},
        {"the recurrence had drifted", [](CgState<double>& s) { make_fresh(s), s.rr = 0.0625; }, 1, 1, 0,
         Then::turn, TAUT_CG_RUNNING, false, 0, TAUT_DIRECTION_STEEPEST},
        {"ended before", ended, 1, 0.25, 0, Then::end, TAUT_CG_INDEFINITE_MATRIX, false},
        {"ended before, and small", ended, kTiny, kTiny, 0, Then::end, TAUT_CG_INDEFINITE_MATRIX, false},
    };
}

/// The settings and numbers in another precision; only values that float holds exactly are used.
template <typename Real>
CgState<Real> in_precision(const CgState<double>& s)
{
    CgState<Real> out = middle_of_solve<Real>();
    out.bb = Real(s.bb);
    out.rr = Real(s.rr);
    out.step = Real(s.step);
    out.iteration = s.iteration;
    out.waited = s.waited;
    out.status = s.status;
    out.begun = s.begun;
    out.fresh = s.fresh;
    out.direction = s.direction;
    out.exhausted = s.exhausted;
    out.stalls = s.stalls;
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("cg_direction adds the last step to x and turns to z + beta p", "", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "diagonal", "block", "stored");
    for (const Dealt& dealt : deals())
    {
        CAPTURE(variant, dealt.count, dealt.groups);
        Random random(70 + dealt.count);
        const Preconditioned<Real> m(variant, dealt.count, random);
        auto r = random_reals<Real>(random, m.rows + 7), p = random_reals<Real>(random, m.rows + 7);
        const auto x = random_reals<Real>(random, m.rows + 7);
        for (std::uint32_t row = 0; row < m.rows; ++row)
            if (m.held(row))
                r[row] = p[row] = 0;
        const auto partials = random_reals<Real>(random, 3 * dealt.groups, 0.5, 1);
        double rz = 0, rr = 0;
        for (std::uint32_t g = 0; g < dealt.groups; ++g)
        {
            rz += double(partials[g]);
            rr += double(partials[dealt.groups + g]);
        }
        CgState<Real> before = middle_of_solve<Real>();
        before.iteration = 12 + kHistory;
        Case c = make_case<Real>(before, r, p, x, partials);
        c.in["inverse"] = bytes_of(m.inverse);
        c.launches = {
            make_launch(kernels::cg_direction::info(variant, c.precision),
                        kernels::cg_direction::Params{dealt.count, dealt.chunk(), dealt.groups, kHistory, 0},
                        dealt.dispatched())};
        const double beta = rz / 2, step = 0.375;
        const std::vector<double> residual = to_doubles(r);
        Field &direction = c.expected["direction"], &moved = c.expected["x"];
        for (std::uint32_t row = 0; row < m.rows; ++row)
        {
            double z = 0, size = 0;
            m.apply(residual, row, z, size);
            const double along = double(p[row]), at = double(x[row]);
            direction.add(z + beta * along, size + beta * std::abs(along));
            moved.add(at + step * along, m.held(row) ? 0 : std::abs(at) + step * std::abs(along));
        }
        add_unchanged(direction, p, m.rows);
        add_unchanged(moved, x, m.rows);
        look_on_every_device(c, [&](const Buffers& out) {
            const CgState<Real> after = state_after<Real>(out);
            CHECK(double(after.rz) == near<Real>(rz));
            CHECK(double(after.rr) == near<Real>(rr));
            CHECK(double(after.pmp) == near<Real>(rz + beta * beta * 3));
            CHECK((after.bb == 4 && after.step == 0 && after.fresh == 0));
            CHECK(after.iteration == before.iteration + 1);
            const auto control = values_of<std::uint32_t>(out.at("control"));
            CHECK(control[TAUT_CONTROL_ITERATE] == dealt.groups);
            CHECK(control[TAUT_CONTROL_REPLACE] == 0);
            for (std::uint32_t k = 0; k < kHistory; ++k)
            {
                const std::uint32_t word = control[TAUT_CONTROL_HISTORY + k];
                if (k == 12) // iteration 28 of a ring of 16
                    CHECK(double(std::bit_cast<float>(word)) == near<float>(std::sqrt(rr / 4)));
                else
                    CHECK(word == 77u);
            }
        });
    }
}

TEMPLATE_TEST_CASE("cg_direction decides how a solve goes on or ends", "", float, double)
{
    using Real = TestType;
    for (const Decision& d : decisions())
    {
        CAPTURE(d.name);
        CgState<double> state = middle_of_solve<double>();
        d.change(state);
        const CgState<Real> before = in_precision<Real>(state);
        Random random(5);
        const std::uint32_t count = 200, groups = 2;
        const auto r = random_reals<Real>(random, count), p = random_reals<Real>(random, count);
        const auto x = random_reals<Real>(random, count);
        const std::vector<Real> partials = {Real(d.rz), 0, Real(d.rr), 0, Real(d.bb), 0};
        Case c = make_case<Real>(before, r, p, x, partials);
        c.launches = {make_launch(
            kernels::cg_direction::info("", c.precision),
            kernels::cg_direction::Params{count, 128, groups, kHistory, d.last ? 1u : 0u}, groups + 1)};
        // Without a direction in hand p may be left over from another solve.
        const bool alone = d.direction == TAUT_DIRECTION_STEEPEST;
        const double beta = alone ? 0 : d.rz / 2, step = d.steps ? double(before.step) : 0;
        Field &direction = c.expected["direction"], &moved = c.expected["x"];
        for (std::uint32_t i = 0; i < count; ++i)
        {
            const double z = double(r[i]), along = double(p[i]), at = double(x[i]);
            if (d.then == Then::turn)
                direction.add(z + beta * along, std::abs(z) + std::abs(beta * along));
            else
                direction.add(along, 0);
            moved.add(at + step * along, step == 0 ? 0 : std::abs(at) + std::abs(step * along));
        }
        const bool finite = std::isfinite(d.rz) && std::isfinite(d.rr) && std::isfinite(d.bb);
        look_on_every_device(
            c,
            [&](const Buffers& out) {
                const CgState<Real> after = state_after<Real>(out);
                CHECK(after.status == d.status);
                CHECK(after.step == 0);
                CHECK(after.stalls == d.stalls);
                CHECK(after.direction == d.direction);
                CHECK(after.begun == 1);
                CHECK(after.iteration == before.iteration + (d.then == Then::turn ? 1u : 0u));
                const auto control = values_of<std::uint32_t>(out.at("control"));
                CHECK(control[TAUT_CONTROL_ITERATE] == (d.then == Then::turn ? groups : 0u));
                CHECK(control[TAUT_CONTROL_REPLACE] == (d.then == Then::replace ? groups : 0u));
                for (const int k : {1, 2, 5, 6}) // the other dimensions are cg_restart's
                    CHECK(control[std::size_t(k)] == 77u);
            },
            finite);
    }
}

TEST_CASE("cg_direction asks only for the groups that hold rows in use")
{
    CgState<float> before = middle_of_solve<float>();
    const std::uint32_t groups = 5, used = GENERATE(0u, 1u, 3u, 5u);
    const std::vector<float> rows(600, 0.5f);
    Case c = make_case<float>(before, rows, rows, rows, std::vector<float>(3 * groups, 0.25f));
    auto words = fresh_control();
    words[TAUT_CONTROL_GROUPS] = used;
    c.in["control"] = bytes_of(words);
    c.launches = {make_launch(kernels::cg_direction::info("", c.precision),
                              kernels::cg_direction::Params{600, 128, groups, 0, 0}, groups)};
    look_on_every_device(c, [&](const Buffers& out) {
        const auto control = values_of<std::uint32_t>(out.at("control"));
        CHECK(control[TAUT_CONTROL_ITERATE] == (used == 0 ? groups : used));
        CHECK(control[TAUT_CONTROL_GROUPS] == used);
    });
}

TEMPLATE_TEST_CASE("cg_direction keeps what the next decisions need", "", float, double)
{
    using Real = TestType;
    CgState<Real> before = middle_of_solve<Real>();
    const bool fresh = GENERATE(false, true);
    before.fresh = fresh ? 1 : 0;
    const double rr = GENERATE(0.25, 0.75, 16.0); // a new smallest, none, a new peak
    CAPTURE(fresh, rr);
    Case c = make_case<Real>(before, {1}, {1}, {1}, {1, Real(rr), 0});
    c.launches = {make_launch(kernels::cg_direction::info("", c.precision),
                              kernels::cg_direction::Params{1, 128, 1, 0, 0}, 1)};
    look_on_every_device(c, [&](const Buffers& out) {
        const CgState<Real> after = state_after<Real>(out);
        CHECK(double(after.peak) == (fresh ? rr : std::max(8.0, rr)));
        CHECK(double(after.lowest) == (fresh ? rr : std::min(0.5, rr)));
        CHECK(double(after.best) == (fresh ? std::min(8.0, rr) : 8.0));
        CHECK(after.waited == (fresh ? 1u : rr < 0.5 ? 0u : 4u));
        const auto control = values_of<std::uint32_t>(out.at("control"));
        for (std::size_t k = TAUT_CONTROL_HISTORY; k < control.size(); ++k)
            CHECK(control[k] == 77u); // no history is asked for
    });
}
