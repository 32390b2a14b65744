#pragma once
// Records and buffers of a kernel with lanes: what READ, UPDATE and their like declare.

#include "taut/runtime/cpu/lane_memory.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

namespace taut::lanes {

/// One word of a record. The member that it becomes decides which of the two it is.
struct Word
{
    Real value;
    Uint index;

    TAUT_LANE operator Real() const { return value; }
    TAUT_LANE operator Uint() const { return index; }
};

template <std::size_t>
using WordAt = Word;

template <typename T, std::size_t... k>
constexpr bool has_members(std::index_sequence<k...>)
{
    return requires { T{RecordTypes{}, std::declval<WordAt<k>>()...}; };
}

/// Words of a record of this many or more members.
template <typename T, std::size_t n = 1>
constexpr std::size_t count_words()
{
    if constexpr (has_members<T>(std::make_index_sequence<n + 1>()))
        return count_words<T, n + 1>();
    else
        return n;
}

template <typename T>
inline constexpr std::size_t kWords = count_words<T>();
template <>
inline constexpr std::size_t kWords<Real> = 1;
template <>
inline constexpr std::size_t kWords<uint> = 1;
template <>
inline constexpr std::size_t kWords<Vec4> = 4;

template <typename T>
inline constexpr std::size_t kBytes = 4 * kWords<T>;

/// Word `k` of a record per element. Four at a time, as rows; what nobody asks for the compiler leaves out.
template <std::size_t words, std::size_t k>
TAUT_LANE Word load_word(const std::byte* base, Index where)
{
    const Neighbours at(base, where, 4 * words);
    const auto word = [&](Real value) __attribute__((always_inline)) {
        return Word{value, Uint{at.first + 4 * k, 4 * words, where, value}};
    };
    if constexpr (words < 4)
        return word(load_real(Neighbours(base + 4 * k, where, 4 * words)));
    else if constexpr (words == 4)
        return word(Real(columns_of(rows_at(base, where)).at[k]));
    else
    {
        constexpr std::size_t first = k / 4 * 4 + 4 <= words ? k / 4 * 4 : words - 4;
        const Rows rows = load_rows(Neighbours(base + 4 * first, where, 4 * words));
        return word(Real(columns_of(rows).at[k - first]));
    }
}

/// Word `k` of the same record for all.
TAUT_LANE Word spread_word(const std::byte* record, std::size_t k)
{
    float value;
    std::memcpy(&value, record + 4 * k, 4);
    return {Real(value), Uint{record + 4 * k, 0, Index(0), Real(value)}};
}

template <typename T, std::size_t... k>
TAUT_LANE T load_record(const std::byte* base, Index where, std::index_sequence<k...>)
{
    return T{RecordTypes{}, load_word<sizeof...(k), k>(base, where)...};
}

template <typename T, std::size_t... k>
TAUT_LANE T spread_record(const std::byte* record, std::index_sequence<k...>)
{
    return T{RecordTypes{}, spread_word(record, k)...};
}

/// What T is when elements of a block read it: a uint becomes one per element.
template <typename T, typename Where>
TAUT_LANE auto load(const std::byte* base, const Where& where)
{
    if constexpr (std::is_same_v<T, uint> && std::is_same_v<Where, Uint>)
        return Whole{_mm256_castps_si256(real_at(base, where).v)};
    else if constexpr (std::is_same_v<T, uint>)
        return Uint{Neighbours(base, where, 4).first, 4, where, real_at(base, where)};
    else if constexpr (std::is_same_v<T, Real>)
        return real_at(base, where);
    else if constexpr (std::is_same_v<T, Vec4>)
        return Vec4(rows_at(base, where));
    else
        return load_record<T>(base, where, std::make_index_sequence<kWords<T>>());
}

/// The same element for all.
template <typename T>
TAUT_LANE T spread(const std::byte* at)
{
    if constexpr (std::is_same_v<T, uint>)
        return *reinterpret_cast<const uint*>(at);
    else if constexpr (std::is_same_v<T, Real>)
        return spread_word(at, 0).value;
    else if constexpr (std::is_same_v<T, Vec4>)
        return Vec4(spread_word(at, 0), spread_word(at, 1), spread_word(at, 2), spread_word(at, 3));
    else
        return spread_record<T>(at, std::make_index_sequence<kWords<T>>());
}

template <typename T>
struct Read
{
    const std::byte* base;

    TAUT_LANE auto operator[](Index where) const { return load<T>(base, where); }
    TAUT_LANE auto operator[](const Uint& where) const { return load<T>(base, where); }
    TAUT_LANE auto operator[](Steps where) const { return load<T>(base, where); }
    TAUT_LANE T operator[](uint index) const { return spread<T>(base + std::size_t{index} * kBytes<T>); }
};

/// An element that can be stored to, Real or Vec4.
template <typename T, typename Where>
struct Ref
{
    std::byte* base;
    Where where;

    TAUT_LANE operator T() const { return load<T>(base, where); }
    TAUT_LANE const Ref& operator=(const T& value) const
    {
        if (!only_looks(where))
            store(base, where, value);
        return *this;
    }
};

template <typename T>
struct Update
{
    std::byte* base;

    TAUT_LANE Ref<T, Index> operator[](Index where) const { return {base, where}; }
    TAUT_LANE Ref<T, Uint> operator[](const Uint& where) const { return {base, where}; }
    TAUT_LANE Ref<T, Steps> operator[](Steps where) const { return {base, where}; }
};

/// A counter per element.
struct CounterOfEach
{
    uint* base;
    Uint where;
};

struct Counters
{
    uint* base;

    TAUT_LANE uint& operator[](uint index) const { return base[index]; }
    TAUT_LANE CounterOfEach operator[](const Uint& where) const { return {base, where}; }
};

/// A copy: what no store can change stays in registers through the loop.
template <typename T>
struct One
{
    std::byte copy[kBytes<T>];

    TAUT_LANE T operator[](uint) const { return spread<T>(copy); }
};

template <typename T>
TAUT_LANE void attach(Read<T>& member, void* memory)
{
    member.base = static_cast<const std::byte*>(memory);
}
template <typename T>
TAUT_LANE void attach(Update<T>& member, void* memory)
{
    member.base = static_cast<std::byte*>(memory);
}
template <typename T>
TAUT_LANE void attach(One<T>& member, void* memory)
{
    std::memcpy(member.copy, memory, sizeof(member.copy));
}
TAUT_LANE void attach(Counters& member, void* memory) { member.base = static_cast<uint*>(memory); }

} // namespace taut::lanes
