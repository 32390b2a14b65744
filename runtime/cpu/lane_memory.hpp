#pragma once
// Buffers as a kernel with lanes sees them: loads gather, stores scatter.

#include "taut/runtime/cpu/lane_forms.hpp"

#include <type_traits>
#include <utility>

namespace taut::lanes {

/// The elements of a block: first, first + 1, ... The ones behind the `count`-th are the last one again: they
/// do its work once more and store the same result, which is harmless; only events must not be counted.
struct Index
{
    uint first;
    uint count = kLanes;
    Form form = Form::any;      ///< of what the elements index with; others than `any` for whole blocks only
    Lookout* lookout = nullptr; ///< if there is one, nothing is stored: it sees what would be indexed with

    // Copied member by member: GCC leaves copies of whole structures in memory.
    Index() = default;
    TAUT_LANE explicit Index(uint f, uint n = kLanes, Form form_of_indices = Form::any, Lookout* l = nullptr)
        : first(f),
          count(n),
          form(form_of_indices),
          lookout(l)
    {}
    TAUT_LANE Index(const Index& other) : Index(other.first, other.count, other.form, other.lookout) {}

    /// How many records lie between the first element's and this one's.
    TAUT_LANE std::size_t behind(uint element) const { return element < count ? element : count - 1; }
};

/// What kernels know as ELEMENT: an Index whose form is part of its type, so that every function that takes
/// one is compiled for that form alone.
template <Form form, bool looks = false>
struct Element
{
    uint first;
    uint count = kLanes;
    Lookout* lookout = nullptr;

    TAUT_LANE operator Index() const { return Index(first, count, form, looks ? lookout : nullptr); }
    TAUT_LANE friend Element operator+(uint a, Element b) { return {a + b.first, b.count, b.lookout}; }
    TAUT_LANE friend Element operator+(Element a, uint b) { return b + a; }
};

/// factor * element + offset for the elements of a block: one of several places that each element has.
struct Steps
{
    Index where;
    uint factor;
    uint offset = 0;
};

template <Form form, bool looks>
TAUT_LANE Steps operator*(uint factor, Element<form, looks> where)
{
    return {where, factor};
}
TAUT_LANE Steps operator+(Steps a, uint b) { return {a.where, a.factor, a.offset + b}; }

/// A number per element that a read-only buffer holds, to index with. It stays where it is until it is
/// wanted: loading it again is cheaper than taking a vector register apart.
struct Uint
{
    const std::byte* first; ///< of the block's first element
    std::size_t stride;
    Index where;
    Real bits; ///< the numbers themselves, for those who want all at once

    Uint() = default;
    TAUT_LANE Uint(const std::byte* f, std::size_t s, Index w, Real b)
        : first(f),
          stride(s),
          where(w),
          bits(b)
    {}
    TAUT_LANE Uint(const Uint& other) : Uint(other.first, other.stride, other.where, other.bits) {}

    TAUT_LANE uint operator[](uint element) const
    {
        return *reinterpret_cast<const uint*>(first + where.behind(element) * stride);
    }
};

TAUT_LANE Bool operator==(const Uint& a, uint b)
{
    const __m256i all = _mm256_set1_epi32(static_cast<int>(b));
    return Bool(_mm256_castsi256_ps(_mm256_cmpeq_epi32(_mm256_castps_si256(a.bits.v), all)));
}

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
    std::byte* base; ///< of element 0's record, where the block has a form
    std::size_t stride;
    Uint where;

    TAUT_LANE Scattered(const std::byte* b, const Uint& index, std::size_t bytes)
        : base(const_cast<std::byte*>(b) + (index.where.form == Form::any ? 0 : index[0] * bytes)),
          stride(bytes),
          where(index)
    {}
    TAUT_LANE std::byte* operator[](uint element) const
    {
        const Form form = where.where.form;
        return base + (form == Form::any ? where[element] : behind_first(form, element)) * stride;
    }
};

/// Whether elements 2r and 2r + 1 of a block reach neighbours: true of all forms.
TAUT_LANE bool in_pairs(const Uint& where) { return where.where.form != Form::any; }

/// Tells the block's lookout, if it has one. True: nothing may be stored.
TAUT_LANE bool only_looks(const Uint& where)
{
    if (!where.where.lookout)
        return false;
    where.where.lookout->see(_mm256_castps_si256(where.bits.v), where.first);
    return true;
}
TAUT_LANE bool only_looks(Index where) { return where.lookout != nullptr; }
TAUT_LANE bool only_looks(const Steps& where) { return only_looks(where.where); }

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
    only_looks(where);
    const Scattered at(base, where, 16);
    if (!in_pairs(where))
        return load_rows(at);
    return {{_mm256_loadu_ps(floats(at[0])), _mm256_loadu_ps(floats(at[2])), _mm256_loadu_ps(floats(at[4])),
             _mm256_loadu_ps(floats(at[6]))}};
}
TAUT_LANE Real real_at(const std::byte* base, const Uint& where)
{
    only_looks(where);
    return load_real(Scattered(base, where, 4));
}
TAUT_LANE void store(std::byte* base, const Uint& where, const Vec4& value)
{
    const Scattered at(base, where, 16);
    if (!in_pairs(where))
        return store_rows(at, value.rows);
    for (uint r = 0; r < 4; ++r)
        _mm256_storeu_ps(floats(at[2 * r]), value.rows.pair[r]);
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
