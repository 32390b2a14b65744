#include "taut/kernels/diagonal_inverse.hpp"

#include "support/linear_groups.hpp"

#include <array>
#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kMissing = 0xffffffffu;
constexpr std::uint32_t kBehind = 3; ///< rows or blocks behind the count must stay as they are

template <typename Real>
struct Input
{
    std::vector<Real> values;
    std::vector<std::uint32_t> slots, held;
};

/// Values in an order of their own, and slots that find them.
template <typename Real>
Input<Real> shuffled(Random& random, const std::vector<Real>& entries, const std::vector<bool>& missing)
{
    Input<Real> in;
    const auto n = static_cast<std::uint32_t>(entries.size());
    in.values.assign(n + 5, std::numeric_limits<Real>::quiet_NaN()); // what no slot names
    for (std::uint32_t k = 0; k < n; ++k)
        in.slots.push_back(k);
    for (std::uint32_t k = n; k > 1; --k)
        std::swap(in.slots[k - 1], in.slots[static_cast<std::uint32_t>(random.uniform(0, 1) * k) % k]);
    for (std::uint32_t k = 0; k < n; ++k)
        if (missing[k])
            in.slots[k] = kMissing;
        else
            in.values[in.slots[k]] = entries[k];
    return in;
}

template <typename Real>
Case case_of(const std::string& variant, const Dealt& dealt, const Input<Real>& in, std::size_t out)
{
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"values", bytes_of(in.values)},
            {"slots", bytes_of(in.slots)},
            {"held", bytes_of(in.held)},
            {"inverse", bytes_of(std::vector<Real>(out, Real(-77)))}};
    const kernels::diagonal_inverse::Params params{dealt.count, dealt.chunk()};
    c.launches = {
        make_launch(kernels::diagonal_inverse::info(variant, c.precision), params, dealt.dispatched())};
    return c;
}

using Matrix = std::array<std::array<long double, 3>, 3>;

/// By cofactors: not as the kernel does it.
Matrix inverse_of(const Matrix& m)
{
    Matrix out{};
    const auto cofactor = [&](int i, int j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    const long double determinant =
        m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out[i][j] = cofactor(j, i) / determinant;
    return out;
}

bool positive_definite(const Matrix& m)
{
    const long double two = m[0][0] * m[1][1] - m[0][1] * m[0][1];
    const long double three = two * m[2][2] - m[0][0] * m[1][2] * m[1][2] - m[1][1] * m[0][2] * m[0][2] +
                              2 * m[0][1] * m[0][2] * m[1][2];
    return m[0][0] > 0 && two > 0 && three > 0;
}

/// What is planted at a block, in turn.
enum Kind
{
    plain,
    missing_pair,
    lopsided,
    zero_row,
    negative,
    indefinite,
    singular,
    graded,
    not_finite
};
constexpr std::uint32_t kKinds = 9;

Matrix random_block(Random& random, Kind kind)
{
    Matrix m{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j)
            m[i][j] = m[j][i] = i == j ? random.uniform(2.0, 4.0) : random.uniform(-0.9, 0.9);
    if (kind == missing_pair)
        m[0][2] = m[2][0] = 0;
    if (kind == lopsided)
        m[1][2] += 0.125L;
    if (kind == zero_row)
        for (int i = 0; i < 3; ++i)
            m[1][i] = m[i][1] = 0;
    if (kind == negative)
        m[2][2] = -m[2][2];
    if (kind == indefinite)
        m[0][1] = m[1][0] = 6;
    if (kind == singular)
        m = {{{1.5L, 1.5L, 1.5L}, {1.5L, 1.5L, 1.5L}, {1.5L, 1.5L, 1.5L}}};
    const long double sizes[] = {1e-6L, 1, 1e6L};
    for (int i = 0; kind == graded && i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m[i][j] *= sizes[i] * sizes[j];
    if (kind == not_finite)
        m[1][1] = std::numeric_limits<long double>::infinity();
    return m;
}

/// The mean of mirrored entries, with 1 on the diagonal of held and zero rows and nothing beside it.
Matrix free_part(const Matrix& m, const std::uint32_t* held)
{
    Matrix out{};
    const auto left_out = [&](int i) { return held[i] != 0 || m[i][i] == 0; };
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (i == j)
                out[i][i] = left_out(i) ? 1 : m[i][i];
            else if (!left_out(i) && !left_out(j))
                out[i][j] = (m[i][j] + m[j][i]) / 2;
    return out;
}

/// The inverse entry by entry with the size of its error for one rounding: the square of the inverse of the
/// block scaled to a unit diagonal, scaled back.
void add_block(Field& field, const Matrix& given, const std::uint32_t* held, Kind kind)
{
    const Matrix m = free_part(given, held);
    const bool diagonal_alone = kind == negative || kind == indefinite || kind == not_finite;
    const bool any_held = held[0] || held[1] || held[2];
    Matrix unit = m, inverse{};
    long double root[3], size = 0;
    for (int i = 0; i < 3; ++i)
        root[i] = std::isinf(m[i][i]) ? 1 : 1 / std::sqrt(std::abs(m[i][i]));
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            unit[i][j] = diagonal_alone ? (i == j ? 1 : 0) : m[i][j] * root[i] * root[j];
    inverse = inverse_of(unit);
    for (const auto& row : inverse)
        for (const long double entry : row)
            size += entry * entry;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            if (held[i] || held[j])
                field.add(0, 0);
            else if (kind == singular || (any_held && diagonal_alone))
                field.add(0, kAnyFinite); // positive definite: the test looks
            else
                field.add(static_cast<double>(inverse[i][j] * root[i] * root[j]),
                          static_cast<double>(diagonal_alone && i != j ? 0 : size * root[i] * root[j]));
}

} // namespace

TEMPLATE_TEST_CASE("diagonal_inverse inverts the diagonal that slots find", "", float, double)
{
    using Real = TestType;
    for (const Dealt& dealt : deals())
    {
        CAPTURE(dealt.count, dealt.groups);
        Random random(300 + dealt.count);
        const std::size_t n = dealt.count + kBehind;
        std::vector<Real> entries = random_reals<Real>(random, n, 0.01, 100);
        std::vector<bool> missing(n, false);
        const Real infinity = std::numeric_limits<Real>::infinity();
        const Real planted[] = {0, -4, infinity, std::numeric_limits<Real>::quiet_NaN(), -infinity};
        for (std::size_t i = 5; i < n; i += 11)
            entries[i] = planted[i / 11 % 5];
        for (std::size_t i = 3; i < n; i += 13)
            missing[i] = true;
        Input<Real> in = shuffled(random, entries, missing);
        for (std::size_t i = 0; i < n; ++i)
            in.held.push_back(i % 7 == 4 ? 0x80000000u : i % 31 == 5 ? 1u : 0u);
        Case c = case_of("", dealt, in, n);
        Field& field = c.expected["inverse"];
        for (std::uint32_t i = 0; i < dealt.count; ++i)
        {
            const double d = missing[i] ? 0 : std::abs(static_cast<double>(entries[i]));
            const double want = in.held[i] ? 0 : d > 0 && std::isfinite(d) ? 1 / d : 1;
            field.add(want, d > 0 && std::isfinite(d) && !in.held[i] ? want : 0);
        }
        add_unchanged(field, std::vector<Real>(kBehind, Real(-77)));
        check_on_every_device(c);
    }
}

TEMPLATE_TEST_CASE("diagonal_inverse inverts blocks on the diagonal without their held rows", "", float,
                   double)
{
    using Real = TestType;
    for (const Dealt& dealt : deals())
    {
        CAPTURE(dealt.count, dealt.groups);
        Random random(400 + dealt.count);
        const std::size_t n = dealt.count + kBehind;
        std::vector<Real> entries;
        std::vector<bool> missing;
        std::vector<std::uint32_t> held;
        const auto kind_of = [](std::uint32_t block) { return static_cast<Kind>(block % kKinds); };
        for (std::uint32_t block = 0; block < n; ++block)
        {
            const Matrix m = random_block(random, kind_of(block));
            for (int e = 0; e < 9; ++e)
            {
                entries.push_back(static_cast<Real>(m[e / 3][e % 3]));
                missing.push_back(m[e / 3][e % 3] == 0 && block % 2 == 0); // else a stored zero
            }
            const std::uint32_t held_bits = block % 5 == 3 ? block / 5 % 8 : 0;
            for (std::uint32_t i = 0; i < 3; ++i)
                held.push_back(held_bits >> i & 1u);
        }
        Input<Real> in = shuffled(random, entries, missing);
        in.held = held;
        Case c = case_of("block", dealt, in, 6 * n);
        Field& field = c.expected["inverse"];
        for (std::uint32_t block = 0; block < dealt.count; ++block)
        {
            Matrix m{};
            for (int e = 0; e < 9; ++e)
                m[e / 3][e % 3] = entries[9 * block + static_cast<std::uint32_t>(e)];
            add_block(field, m, &held[3 * block], kind_of(block));
        }
        add_unchanged(field, std::vector<Real>(6 * kBehind, Real(-77)));
        look_on_every_device(c, [&](const Buffers& out) {
            const auto inverse = values_of<Real>(out.at("inverse"));
            for (std::uint32_t block = 0; block < dealt.count; ++block)
            {
                const Real* v = &inverse[6 * block];
                Matrix m = {{{v[0], v[1], v[2]}, {v[1], v[3], v[4]}, {v[2], v[4], v[5]}}};
                for (std::uint32_t i = 0; i < 3; ++i)
                    if (held[3 * block + i])
                        m[i][i] = 1;
                INFO("block " << block); // whatever the block
                REQUIRE(positive_definite(m));
            }
        });
    }
}
