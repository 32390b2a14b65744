#pragma once
// Buffers as a kernel with lanes sees them: loads gather, stores scatter.

#include "taut/runtime/cpu/lanes.hpp"

#include <type_traits>
#include <utility>

namespace taut::lanes {

/// The elements of a block: first, first + 1, ... The ones behind the `count`-th are the last one again: they
/// do its work once more and store the same result, which is harmless; only events must not be counted.
struct Index
{
    uint first;
    uint count = kLanes;

    /// How many records lie between the first element's and this one's.
    TAUT_LANE std::size_t behind(uint element) const { return element < count ? element : count - 1; }
};

TAUT_LANE Index operator+(uint a, Index b) { return {a + b.first, b.count}; }
TAUT_LANE Index operator+(Index a, uint b) { return b + a; }

/// factor * element + offset for the elements of a block: one of several places that each element has.
struct Steps
{
    Index where;
    uint factor;
    uint offset = 0;
};

TAUT_LANE Steps operator*(uint factor, Index where) { return {where, factor}; }
TAUT_LANE Steps operator+(Steps a, uint b) { return {a.where, a.factor, a.offset + b}; }

/// A number per element that a read-only buffer holds, to index with. It stays where it is until it is
/// wanted: loading it again is cheaper than taking a vector register apart.
struct Uint
{
    const std::byte* first; ///< of the block's first element
    std::size_t stride;
    Index where;

    TAUT_LANE uint operator[](uint element) const
    {
        return *reinterpret_cast<const uint*>(first + where.behind(element) * stride);
    }
};

/// The records of a block's elements in a buffer of records of `stride` bytes. One pointer for neighbours:
/// what is added to it then is known when this is compiled.
struct Neighbours
{
    std::byte* first;
    std::size_t stride;
    Index where;

    TAUT_LANE Neighbours(const std::byte* base, Index index, std::size_t bytes)
        : first(const_cast<std::byte*>(base) + index.first * bytes),
          stride(bytes),
          where(index)
    {}
    TAUT_LANE Neighbours(const std::byte* base, Steps steps, std::size_t bytes)
        : first(const_cast<std::byte*>(base) +
                (std::size_t{steps.factor} * steps.where.first + steps.offset) * bytes),
          stride(steps.factor * bytes),
          where(steps.where)
    {}
    TAUT_LANE std::byte* operator[](uint element) const { return first + where.behind(element) * stride; }
};

struct Scattered
{
    std::byte* base;
    std::size_t stride;
    Uint where;

    TAUT_LANE Scattered(const std::byte* b, Uint index, std::size_t bytes)
        : base(const_cast<std::byte*>(b)),
          stride(bytes),
          where(index)
    {}
    TAUT_LANE std::byte* operator[](uint element) const { return base + where[element] * stride; }
};

/// Base of the records of a kernel (LAYOUT_STRUCT): what `uint` is inside of them.
struct RecordTypes
{
    using uint = Uint;
};

TAUT_LANE float* floats(std::byte* at) { return reinterpret_cast<float*>(at); }

/// Four floats per element.
template <typename Records>
TAUT_LANE Rows load_rows(const Records& at)
{
    Rows rows;
    for (uint r = 0; r < 4; ++r)
        rows.pair[r] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(floats(at[2 * r]))),
                                            _mm_loadu_ps(floats(at[2 * r + 1])), 1);
    return rows;
}

template <typename Records>
TAUT_LANE void store_rows(const Records& at, const Rows& rows)
{
    for (uint r = 0; r < 4; ++r)
    {
        _mm_storeu_ps(floats(at[2 * r]), _mm256_castps256_ps128(rows.pair[r]));
        _mm_storeu_ps(floats(at[2 * r + 1]), _mm256_extractf128_ps(rows.pair[r], 1));
    }
}

template <typename Records>
TAUT_LANE Real load_real(const Records& at)
{
    return Real(_mm256_setr_ps(*floats(at[0]), *floats(at[2]), *floats(at[4]), *floats(at[6]), *floats(at[1]),
                               *floats(at[3]), *floats(at[5]), *floats(at[7])));
}

template <typename Records>
TAUT_LANE void store_real(const Records& at, Real value)
{
    alignas(32) float lanes[kLanes];
    _mm256_store_ps(lanes, value.v);
    for (uint element = 0; element < kLanes; ++element)
        *floats(at[element]) = lanes[lane_of(element)];
}

TAUT_LANE Rows rows_at(const std::byte* base, const Uint& where)
{
    return load_rows(Scattered(base, where, 16));
}
TAUT_LANE Real real_at(const std::byte* base, const Uint& where)
{
    return load_real(Scattered(base, where, 4));
}
TAUT_LANE void store(std::byte* base, const Uint& where, const Vec4& value)
{
    store_rows(Scattered(base, where, 16), value.rows);
}
TAUT_LANE void store(std::byte* base, const Uint& where, Real value)
{
    store_real(Scattered(base, where, 4), value);
}

TAUT_LANE Rows rows_at(const std::byte* base, const Steps& where)
{
    return load_rows(Neighbours(base, where, 16));
}
TAUT_LANE void store(std::byte* base, const Steps& where, const Vec4& value)
{
    store_rows(Neighbours(base, where, 16), value.rows);
}

// Neighbours in memory, unless the block is short.
TAUT_LANE Rows rows_at(const std::byte* base, Index where)
{
    const Neighbours at(base, where, 16);
    if (where.count < kLanes)
        return load_rows(at);
    const float* floats_at = floats(at.first);
    return {{_mm256_loadu_ps(floats_at), _mm256_loadu_ps(floats_at + 8), _mm256_loadu_ps(floats_at + 16),
             _mm256_loadu_ps(floats_at + 24)}};
}

TAUT_LANE void store(std::byte* base, Index where, const Vec4& value)
{
    const Neighbours at(base, where, 16);
    if (where.count < kLanes)
        return store_rows(at, value.rows);
    for (uint r = 0; r < 4; ++r)
        _mm256_storeu_ps(floats(at.first) + 8 * r, value.rows.pair[r]);
}

TAUT_LANE Real real_at(const std::byte* base, Index where)
{
    const Neighbours at(base, where, 4);
    if (where.count < kLanes)
        return load_real(at);
    const __m256i evens_first = _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7);
    return Real(_mm256_permutevar8x32_ps(_mm256_loadu_ps(floats(at.first)), evens_first));
}

TAUT_LANE void store(std::byte* base, Index where, Real value)
{
    const Neighbours at(base, where, 4);
    if (where.count < kLanes)
        return store_real(at, value);
    const __m256i by_number = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    _mm256_storeu_ps(floats(at.first), _mm256_permutevar8x32_ps(value.v, by_number));
}

} // namespace taut::lanes
