#pragma once
// The types of a kernel that runs eight elements at a time: `real` is eight floats, `rvec4` eight rows.
//
// A kernel with the line `//! lanes` is compiled a second time, with these types and for processors that have
// AVX2 (docs/lanes.md). Every operation is the one of the scalar build, element by element and in the same
// order, so results agree to the last bit. What is compiled for AVX2 must not be shared with other code, for
// the linker keeps one copy of an inline function, whichever that is: so there is no GLM in here.

#include <cstddef>
#include <cstdint>
#include <immintrin.h>

namespace taut::lanes {

using uint = std::uint32_t;

#define TAUT_LANE [[gnu::always_inline]] inline

inline constexpr uint kLanes = 8;

/// The lane of an element of a block. Rows are held in pairs of neighbours, 2r and 2r + 1, so the even
/// elements come first.
constexpr uint lane_of(uint element) { return element / 2 + element % 2 * 4; }

/// The truth of something per element. Not convertible to bool: select instead of branch.
struct Bool
{
    __m256 mask; ///< a lane has all bits or none

    Bool() = default;
    TAUT_LANE explicit Bool(__m256 m) : mask(m) {}
    TAUT_LANE Bool(bool all) : mask(_mm256_castsi256_ps(_mm256_set1_epi32(all ? -1 : 0))) {}
};

TAUT_LANE Bool operator&&(Bool a, Bool b) { return Bool(_mm256_and_ps(a.mask, b.mask)); }
TAUT_LANE Bool operator||(Bool a, Bool b) { return Bool(_mm256_or_ps(a.mask, b.mask)); }
TAUT_LANE Bool operator!(Bool a) { return Bool(_mm256_xor_ps(a.mask, Bool(true).mask)); }

/// A bit per lane.
TAUT_LANE uint bits(Bool a) { return static_cast<uint>(_mm256_movemask_ps(a.mask)); }

/// A whole number per element, below 2^31, to compute with and not to index with.
struct Whole
{
    __m256i v;
};

struct Real
{
    __m256 v;

    Real() = default;
    TAUT_LANE explicit Real(__m256 values) : v(values) {}
    /// The same number in all lanes.
    TAUT_LANE explicit Real(float all) : v(_mm256_set1_ps(all)) {}
    TAUT_LANE explicit Real(double all) : Real(static_cast<float>(all)) {}
    TAUT_LANE explicit Real(int all) : Real(static_cast<float>(all)) {}
    TAUT_LANE explicit Real(uint all) : Real(static_cast<float>(all)) {}
    TAUT_LANE explicit Real(Whole whole) : v(_mm256_cvtepi32_ps(whole.v)) {}
};

TAUT_LANE Real operator+(Real a, Real b) { return Real(_mm256_add_ps(a.v, b.v)); }
TAUT_LANE Real operator-(Real a, Real b) { return Real(_mm256_sub_ps(a.v, b.v)); }
TAUT_LANE Real operator*(Real a, Real b) { return Real(_mm256_mul_ps(a.v, b.v)); }
TAUT_LANE Real operator/(Real a, Real b) { return Real(_mm256_div_ps(a.v, b.v)); }
TAUT_LANE Real operator-(Real a) { return Real(_mm256_xor_ps(a.v, _mm256_set1_ps(-0.0f))); }
TAUT_LANE Real& operator+=(Real& a, Real b) { return a = a + b; }
TAUT_LANE Real& operator-=(Real& a, Real b) { return a = a - b; }
TAUT_LANE Real& operator*=(Real& a, Real b) { return a = a * b; }
TAUT_LANE Real& operator/=(Real& a, Real b) { return a = a / b; }
TAUT_LANE Bool operator<(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)); }
TAUT_LANE Bool operator>(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_GT_OQ)); }
TAUT_LANE Bool operator<=(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)); }
TAUT_LANE Bool operator>=(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)); }
TAUT_LANE Bool operator==(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)); }
TAUT_LANE Bool operator!=(Real a, Real b) { return Bool(_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)); }

TAUT_LANE Real select(Bool c, Real a, Real b) { return Real(_mm256_blendv_ps(b.v, a.v, c.mask)); }

// As GLM's also for equal operands and for what is no number: the instruction gives its second operand then.
TAUT_LANE Real min(Real a, Real b) { return Real(_mm256_min_ps(b.v, a.v)); } // b < a ? b : a
TAUT_LANE Real max(Real a, Real b) { return Real(_mm256_max_ps(b.v, a.v)); } // b > a ? b : a
TAUT_LANE Real abs(Real a) { return Real(_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)); }
TAUT_LANE Real sqrt(Real a) { return Real(_mm256_sqrt_ps(a.v)); }

// Of what is the same for all elements.
TAUT_LANE uint min(uint a, uint b) { return b < a ? b : a; }
TAUT_LANE uint max(uint a, uint b) { return a < b ? b : a; }

/// Eight rows of four floats as they lie in memory, two in each register: elements 2r and 2r + 1.
struct Rows
{
    __m256 pair[4];
};

/// What lies at places 0 .. 3 of the rows.
struct Columns
{
    __m256 at[4];
};

TAUT_LANE Columns columns_of(const Rows& rows)
{
    const __m256 low0 = _mm256_unpacklo_ps(rows.pair[0], rows.pair[1]);
    const __m256 high0 = _mm256_unpackhi_ps(rows.pair[0], rows.pair[1]);
    const __m256 low1 = _mm256_unpacklo_ps(rows.pair[2], rows.pair[3]);
    const __m256 high1 = _mm256_unpackhi_ps(rows.pair[2], rows.pair[3]);
    return {{_mm256_shuffle_ps(low0, low1, 0x44), _mm256_shuffle_ps(low0, low1, 0xEE),
             _mm256_shuffle_ps(high0, high1, 0x44), _mm256_shuffle_ps(high0, high1, 0xEE)}};
}

/// The way back is the same way.
TAUT_LANE Rows rows_of(const Columns& columns)
{
    const Columns c = columns_of({{columns.at[0], columns.at[1], columns.at[2], columns.at[3]}});
    return {{c.at[0], c.at[1], c.at[2], c.at[3]}};
}

/// A number per element at all four places of its row.
TAUT_LANE Rows rows_of(Real a)
{
    return {{_mm256_permute_ps(a.v, 0x00), _mm256_permute_ps(a.v, 0x55), _mm256_permute_ps(a.v, 0xAA),
             _mm256_permute_ps(a.v, 0xFF)}};
}

/// Place `k` of the rows: what `.x` is. Reads as a Real.
template <int k>
struct Component
{
    Rows rows;

    Component(const Component&) = default;
    TAUT_LANE Component& operator=(const Component& other) { return *this = Real(other); }
    TAUT_LANE operator Real() const { return Real(columns_of(rows).at[k]); }
    TAUT_LANE Component& operator=(Real value)
    {
        const Rows wide = rows_of(value);
        for (int r = 0; r < 4; ++r)
            rows.pair[r] = _mm256_blend_ps(rows.pair[r], wide.pair[r], 0x11 << k);
        return *this;
    }
    /// The component at all places of its row.
    TAUT_LANE Rows spread() const
    {
        constexpr int all = k * 0x55;
        return {{_mm256_permute_ps(rows.pair[0], all), _mm256_permute_ps(rows.pair[1], all),
                 _mm256_permute_ps(rows.pair[2], all), _mm256_permute_ps(rows.pair[3], all)}};
    }
};

struct Vec3;

/// Rows: loads and stores need no transposition, and most of what kernels do with them works on rows.
struct Vec4
{
    union
    {
        Rows rows;
        Component<0> x;
        Component<1> y;
        Component<2> z;
        Component<3> w;
    };

    TAUT_LANE Vec4() {}
    TAUT_LANE Vec4(const Vec4& other) : rows(other.rows) {}
    TAUT_LANE explicit Vec4(const Rows& r) : rows(r) {}
    TAUT_LANE Vec4(Real ax, Real ay, Real az, Real aw) : rows(rows_of(Columns{{ax.v, ay.v, az.v, aw.v}})) {}
    TAUT_LANE Vec4(const Vec3& a, Real aw);
    TAUT_LANE explicit Vec4(Real all) : rows(rows_of(all)) {}
    TAUT_LANE Vec4& operator=(const Vec4& other)
    {
        rows = other.rows;
        return *this;
    }
};

/// A Real per component.
struct Vec3
{
    Real x, y, z;

    Vec3() = default;
    TAUT_LANE Vec3(Real ax, Real ay, Real az) : x(ax), y(ay), z(az) {}
    TAUT_LANE explicit Vec3(Real all) : x(all), y(all), z(all) {}
    TAUT_LANE explicit Vec3(const Vec4& a) : x(a.x), y(a.y), z(a.z) {}
};

TAUT_LANE Vec4::Vec4(const Vec3& a, Real aw) : Vec4(a.x, a.y, a.z, aw) {}

#define TAUT_LANE_OPERATOR(op, instruction)                                                                  \
    TAUT_LANE Vec3 operator op(const Vec3& a, const Vec3& b)                                                 \
    {                                                                                                        \
        return {a.x op b.x, a.y op b.y, a.z op b.z};                                                         \
    }                                                                                                        \
    TAUT_LANE Vec3 operator op(const Vec3& a, Real b) { return {a.x op b, a.y op b, a.z op b}; }             \
    TAUT_LANE Vec3 operator op(Real a, const Vec3& b) { return {a op b.x, a op b.y, a op b.z}; }             \
    TAUT_LANE Vec3& operator op##=(Vec3& a, const Vec3& b) { return a = a op b; }                            \
    TAUT_LANE Vec3& operator op##=(Vec3& a, Real b) { return a = a op b; }                                   \
    TAUT_LANE Rows operator op(const Rows& a, const Rows& b)                                                 \
    {                                                                                                        \
        return {{instruction(a.pair[0], b.pair[0]), instruction(a.pair[1], b.pair[1]),                       \
                 instruction(a.pair[2], b.pair[2]), instruction(a.pair[3], b.pair[3])}};                     \
    }                                                                                                        \
    TAUT_LANE Vec4 operator op(const Vec4& a, const Vec4& b) { return Vec4(a.rows op b.rows); }              \
    TAUT_LANE Vec4 operator op(const Vec4& a, Real b) { return Vec4(a.rows op rows_of(b)); }                 \
    TAUT_LANE Vec4 operator op(Real a, const Vec4& b) { return Vec4(rows_of(a) op b.rows); }                 \
    template <int k>                                                                                         \
    TAUT_LANE Vec4 operator op(const Vec4& a, const Component<k>& b)                                         \
    {                                                                                                        \
        return Vec4(a.rows op b.spread());                                                                   \
    }                                                                                                        \
    TAUT_LANE Vec4& operator op##=(Vec4& a, const Vec4& b) { return a = a op b; }                            \
    TAUT_LANE Vec4& operator op##=(Vec4& a, Real b) { return a = a op b; }
TAUT_LANE_OPERATOR(+, _mm256_add_ps)
TAUT_LANE_OPERATOR(-, _mm256_sub_ps)
TAUT_LANE_OPERATOR(*, _mm256_mul_ps)
TAUT_LANE_OPERATOR(/, _mm256_div_ps)
#undef TAUT_LANE_OPERATOR

TAUT_LANE Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }

TAUT_LANE Vec3 select(Bool c, const Vec3& a, const Vec3& b)
{
    return {select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z)};
}
TAUT_LANE Vec4 select(Bool c, const Vec4& a, const Vec4& b)
{
    const Rows wide = rows_of(Real(c.mask));
    Vec4 out;
    for (int r = 0; r < 4; ++r)
        out.rows.pair[r] = _mm256_blendv_ps(b.rows.pair[r], a.rows.pair[r], wide.pair[r]);
    return out;
}

TAUT_LANE Real dot(const Vec3& a, const Vec3& b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
TAUT_LANE Real length(const Vec3& a) { return sqrt(dot(a, a)); }
TAUT_LANE Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

} // namespace taut::lanes
