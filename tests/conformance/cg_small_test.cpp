#include "taut/kernels/cg_small.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kHistory = 4;

enum class Plan
{
    solve,
    zero_right_hand_side,
    not_a_number,
    negative_definite,
    ended,     ///< before the dispatch
    replacing, ///< with a gained x that goes to the base before the residual is formed anew
};

/// Numbers as the device has them: `value` + `low` is what a pair stands for.
struct Numbers
{
    std::vector<double> value, low;

    template <typename Real>
    void add(double v, bool pairs)
    {
        const auto high = static_cast<double>(static_cast<Real>(v));
        value.push_back(high);
        low.push_back(pairs ? static_cast<double>(static_cast<Real>(v - high)) : 0);
    }
    double at(std::size_t i) const { return value[i] + low[i]; }
};

struct System
{
    Plan plan;
    std::uint32_t rows;
    std::vector<std::uint32_t> row_start = {0}, column;
    Numbers a, b, base;
    std::vector<double> inverse, gained, direction, residual, product;
};

/// Diagonally dominant and symmetric, some four entries a row off the diagonal; one row in ten is held.
template <typename Real>
System make_system(Random& random, std::uint32_t n, Plan plan, bool pairs)
{
    std::vector<std::map<std::uint32_t, double>> rows(n);
    for (std::uint32_t i = 0; i < n; ++i)
        rows[i][i] = random.uniform(8, 12);
    for (std::uint32_t k = 0; k < 2 * n; ++k)
    {
        const std::uint32_t i = random.below(n), j = random.below(n);
        if (i != j)
            rows[i][j] = rows[j][i] = random.uniform(-1, 1);
    }
    System s;
    s.plan = plan;
    s.rows = n;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        for (const auto& [j, v] : rows[i])
        {
            s.column.push_back(j);
            s.a.add<Real>(plan == Plan::negative_definite ? -v : v, pairs);
        }
        s.row_start.push_back(static_cast<std::uint32_t>(s.column.size()));
        const bool held = n > 1 && random.chance(0.1);
        s.inverse.push_back(held ? 0 : static_cast<double>(static_cast<Real>(1 / rows[i][i])));
        s.base.add<Real>(plan == Plan::zero_right_hand_side ? 0 : random.uniform(-1, 1), pairs);
        for (auto* v : {&s.gained, &s.direction, &s.residual, &s.product}) // from another solve
            v->push_back(static_cast<double>(random.uniform<Real>(-1, 1)));
    }
    for (std::uint32_t i = 0; i < n; ++i)
    {
        double b = plan == Plan::zero_right_hand_side ? 0 : random.uniform(-1, 1);
        if (pairs && plan != Plan::zero_right_hand_side) // nearly solved: the residual is all cancellation
        {
            b *= 1e-4;
            for (std::uint32_t k = s.row_start[i]; k < s.row_start[i + 1]; ++k)
                b += s.a.at(k) * s.base.at(s.column[k]);
        }
        s.b.add<Real>(b, pairs);
    }
    if (plan == Plan::not_a_number)
    {
        s.b.value[n / 2] = std::numeric_limits<double>::quiet_NaN();
        s.inverse[n / 2] = 0.125;
    }
    return s;
}

/// What the vectors must be, with the size of the terms that made them.
struct Expected
{
    Field base, base_low, r, p, q, x;
    std::uint32_t status = TAUT_CG_RUNNING;
};

Field exactly(const std::vector<double>& values)
{
    Field f;
    for (const double v : values)
        f.add(v, 0);
    return f;
}

/// Textbook conjugate gradients: the residual anew, then turns - 1 iterations.
Expected reference(const System& s, std::uint32_t turns, bool pairs)
{
    Expected e{exactly(s.base.value), exactly(s.base.low), exactly(s.residual), exactly(s.direction),
               exactly(s.product), exactly(s.gained), TAUT_CG_CONVERGED};
    if (s.plan == Plan::ended)
        return e;
    e.status = TAUT_CG_RUNNING;
    e.r = e.x = {};
    std::vector<double> at(s.rows);
    for (std::uint32_t i = 0; i < s.rows; ++i)
    {
        at[i] = s.base.at(i) + (s.plan == Plan::replacing ? s.gained[i] : 0);
        e.x.add(0, 0);
        if (s.plan != Plan::replacing)
            continue;
        const double high = pairs ? static_cast<double>(static_cast<float>(at[i])) : at[i];
        e.base.value[i] = high;
        e.base.scale[i] = pairs ? 0 : std::abs(at[i]) + std::abs(s.gained[i]);
        e.base_low.value[i] = at[i] - high;
        e.base_low.scale[i] = 0x1p-22 * std::abs(high);
    }
    double rz = 0;
    for (std::uint32_t i = 0; i < s.rows; ++i)
    {
        double r = s.b.at(i), size = std::abs(r);
        for (std::uint32_t k = s.row_start[i]; k < s.row_start[i + 1]; ++k)
        {
            r -= s.a.at(k) * at[s.column[k]];
            size += std::abs(s.a.at(k) * at[s.column[k]]);
        }
        const bool held = s.inverse[i] == 0;
        e.r.add(held ? 0 : r, held ? 0 : pairs ? std::abs(r) + 0x1p-20 * size : size);
        rz += held ? 0 : r * r * s.inverse[i];
    }
    if (s.plan == Plan::zero_right_hand_side || s.plan == Plan::not_a_number)
    {
        e.status = s.plan == Plan::not_a_number ? TAUT_CG_NON_FINITE : TAUT_CG_ZERO_RIGHT_HAND_SIDE;
        return e;
    }
    double beta = 0;
    for (std::uint32_t turn = 1;; ++turn)
    {
        for (std::uint32_t i = 0; i < s.rows; ++i)
        {
            e.p.value[i] = s.inverse[i] * e.r.value[i] + (beta == 0 ? 0 : beta * e.p.value[i]);
            e.p.scale[i] = s.inverse[i] * e.r.scale[i] + beta * e.p.scale[i];
        }
        if (turn == turns)
            return e;
        double curvature = 0;
        for (std::uint32_t i = 0; i < s.rows; ++i)
        {
            e.q.value[i] = e.q.scale[i] = 0;
            for (std::uint32_t k = s.row_start[i]; k < s.row_start[i + 1]; ++k)
            {
                e.q.value[i] += s.a.value[k] * e.p.value[s.column[k]];
                e.q.scale[i] += std::abs(s.a.value[k]) * e.p.scale[s.column[k]];
            }
            curvature += e.p.value[i] * e.q.value[i];
        }
        if (curvature < 0)
        {
            e.status = TAUT_CG_INDEFINITE_MATRIX;
            return e;
        }
        const double alpha = rz / curvature, before = rz;
        rz = 0;
        for (std::uint32_t i = 0; i < s.rows; ++i)
        {
            const bool held = s.inverse[i] == 0;
            e.x.value[i] += alpha * e.p.value[i];
            e.x.scale[i] += alpha * e.p.scale[i];
            e.r.value[i] = held ? 0 : e.r.value[i] - alpha * e.q.value[i];
            e.r.scale[i] = held ? 0 : e.r.scale[i] + alpha * e.q.scale[i];
            rz += e.r.value[i] * e.r.value[i] * s.inverse[i];
        }
        beta = rz / before;
    }
}

void append(Field& to, const Field& part)
{
    to.value.insert(to.value.end(), part.value.begin(), part.value.end());
    to.scale.insert(to.scale.end(), part.scale.begin(), part.scale.end());
}

void append(std::vector<double>& to, const std::vector<double>& part)
{
    to.insert(to.end(), part.begin(), part.end());
}

template <typename Real>
Bytes reals(std::initializer_list<std::vector<double>> parts)
{
    std::vector<Real> all;
    for (const auto& part : parts)
        for (const double v : part)
            all.push_back(static_cast<Real>(v));
    return bytes_of(all);
}

template <typename Real>
layout::CgState<Real> state_of(const System& s)
{
    layout::CgState<Real> state{};
    state.tolerance_squared = Real(1e-30);
    state.replacement_squared = Real(1e-30);
    state.growth_squared = Real(1e16);
    state.epsilon = std::numeric_limits<Real>::epsilon() / 2;
    state.iteration_limit = state.patience = 1000;
    state.status = s.plan == Plan::ended ? TAUT_CG_CONVERGED : TAUT_CG_RUNNING;
    if (s.plan != Plan::replacing)
        return state;
    state.begun = 1;
    state.bb = Real(1);
    state.rz = state.rr = state.pmp = state.peak = state.lowest = state.best = Real(1e6);
    state.growth_squared = Real(1e20);
    return state;
}

template <typename Real>
Case make_case(const std::vector<System>& systems, std::uint32_t turns, bool pairs)
{
    std::vector<std::uint32_t> table, starts = {0}, column, control;
    std::vector<double> a, a_low, inverse, b, b_low, base, base_low, r, p, q, x;
    std::vector<layout::CgState<Real>> states;
    Field fields[6];
    std::uint32_t rows = 0;
    for (const System& s : systems)
    {
        table.insert(table.end(), {rows, s.rows, turns});
        for (std::uint32_t i = 0; i < s.rows; ++i)
            starts.push_back(starts.back() + s.row_start[i + 1] - s.row_start[i]);
        column.insert(column.end(), s.column.begin(), s.column.end());
        append(a, s.a.value), append(a_low, s.a.low), append(inverse, s.inverse);
        append(b, s.b.value), append(b_low, s.b.low), append(base, s.base.value);
        append(base_low, s.base.low);
        append(r, s.residual), append(p, s.direction), append(q, s.product), append(x, s.gained);
        states.push_back(state_of<Real>(s));
        control.insert(control.end(), {s.plan == Plan::ended ? 0u : 1u, 7u, 7u, 7u, 7u});
        const Expected e = reference(s, turns, pairs);
        const Field* parts[] = {&e.base, &e.base_low, &e.r, &e.p, &e.q, &e.x};
        for (int k = 0; k < 6; ++k)
            append(fields[k], *parts[k]);
        rows += s.rows;
    }
    table.insert(table.end(), starts.begin(), starts.end());
    if (!pairs)
        a_low.clear(), b_low.clear(), base_low.clear();
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"table", bytes_of(table)},          {"column", bytes_of(column)},
            {"value", reals<Real>({a, a_low})},  {"given", reals<Real>({inverse, b, b_low})},
            {"base", reals<Real>({base, base_low})}, {"work", reals<Real>({r, p, q, x})},
            {"state", bytes_of(states)},         {"control", bytes_of(control)}};
    append(c.expected["base"], fields[0]);
    if (pairs)
        append(c.expected["base"], fields[1]);
    for (int k = 2; k < 6; ++k)
        append(c.expected["work"], fields[k]);
    const auto count = static_cast<std::uint32_t>(systems.size());
    const kernels::cg_small::Params params{count, rows, starts.back(), kHistory};
    c.launches = {make_launch(kernels::cg_small::info(pairs ? "pairs" : "", c.precision), params, count + 3)};
    c.slack = turns;
    return c;
}

template <typename Real>
void check_batch(std::uint32_t turns, bool pairs)
{
    Random random(700 + turns);
    std::vector<System> systems;
    // A row is solved by one iteration, after which textbook and kernel part.
    for (const std::uint32_t n : {turns == 1 ? 1u : 30u, 63u, 64u, 65u, 127u, 128u, 129u, 1000u})
        systems.push_back(make_system<Real>(random, n, Plan::solve, pairs));
    for (const Plan plan : {Plan::zero_right_hand_side, Plan::not_a_number, Plan::negative_definite,
                            Plan::ended, Plan::replacing, Plan::solve})
        systems.push_back(make_system<Real>(random, 130, plan, pairs));
    const Case c = make_case<Real>(systems, turns, pairs);
    check_on_every_device(c);

    const Buffers out = run(*test_device("cpu:serial"), c.launches, c.in);
    const auto states = values_of<layout::CgState<Real>>(out.at("state"));
    const auto control = values_of<std::uint32_t>(out.at("control"));
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        CAPTURE(k);
        const bool running = states[k].status == TAUT_CG_RUNNING;
        const bool ended = systems[k].plan == Plan::ended;
        CHECK(states[k].status == reference(systems[k], turns, pairs).status);
        const bool indefinite = states[k].status == TAUT_CG_INDEFINITE_MATRIX;
        CHECK(states[k].iteration == (running ? turns : indefinite ? 1 : 0));
        CHECK(states[k].replacements == (systems[k].plan == Plan::replacing ? 1 : 0));
        CHECK(control[5 * k] == 0);
        CHECK((control[5 * k + 1] == 7) == ended);                // |r| / |b| at the start
        CHECK((control[5 * k + 4] == 7) == (ended || !running || turns < 4));
    }
}

} // namespace

TEMPLATE_TEST_CASE("cg_small begins and iterates like textbook conjugate gradients", "", float, double)
{
    const std::uint32_t turns = GENERATE(1u, 2u, 4u);
    CAPTURE(turns);
    check_batch<TestType>(turns, false);
}

TEST_CASE("cg_small in pairs sees a residual that float cannot")
{
    const std::uint32_t turns = GENERATE(1u, 2u, 4u);
    CAPTURE(turns);
    check_batch<float>(turns, true);
}
