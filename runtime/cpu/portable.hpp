#pragma once
// C++ twin of kernels/shared/portable.glsl: what makes a kernel compile as native code.
//
// The build includes a kernel inside `struct Kernel { ... }`, once per variant and precision, in a
// namespace of its own. So buffers are members, functions are member functions, and a breakpoint
// set in the .comp file works.

#define GLM_FORCE_XYZW_ONLY
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace taut::native {

using namespace glm;
using uint = std::uint32_t;
using rbool = bool;

#if TAUT_LANES
/// Whether this processor has what kernels that run several elements at a time are compiled for. Without
/// optimisation they would be slower than one at a time, and nobody could follow them in a debugger.
inline bool has_lanes()
{
#ifdef __OPTIMIZE__
    static const bool yes = __builtin_cpu_supports("avx2");
    return yes;
#else
    return false;
#endif
}
#endif

/// Points a buffer member at its memory. READ_ONE members are copies: a value that no store can change
/// stays in registers through the loop.
template <typename T>
struct One
{
    T value;
    const T& operator[](uint) const { return value; }
};

template <typename Member>
void attach(Member& member, void* memory)
{
    if constexpr (requires { member.value; })
        member.value = *static_cast<const decltype(member.value)*>(memory);
    else
        member = static_cast<Member>(memory);
}

/// Calls `run` with the kernel. A parameter called `report` asks for counting, which only one pass in many
/// does: with it set to a constant 0 the compiler drops the counting from the other passes' loop (an atomic
/// in it would cost a tenth of the time, because values could not be kept across it).
template <typename Kernel, typename Run>
void run_lean(Kernel& kernel, Run run)
{
    if constexpr (requires { kernel.report; })
    {
        if (kernel.report == 0)
        {
            kernel.report = 0;
            run(kernel);
            return;
        }
    }
    run(kernel);
}

/// Runs the elements of a KERNEL. A local copy of the kernel lets the compiler keep buffer pointers
/// and parameters in registers.
template <typename Kernel>
void run_elements(const void* params, void* const* buffers, std::uint32_t begin, std::uint32_t end)
{
    Kernel kernel;
    kernel.bind(params, buffers);
    const std::uint32_t count = kernel.element_count();
    if (end > count)
        end = count;
    run_lean(kernel, [begin, end](Kernel& k) {
        for (std::uint32_t i = begin; i < end; ++i)
            k.element(i);
    });
}

template <typename Kernel>
void run_groups(const void* params, void* const* buffers, std::uint32_t begin, std::uint32_t end)
{
    Kernel kernel;
    kernel.bind(params, buffers);
    run_lean(kernel, [begin, end](Kernel& k) {
        for (std::uint32_t group = begin; group < end; ++group)
            k.body(group);
    });
}

// Lanes of one phase never read what another writes, so the compiler may run several at once.
#if defined(__clang__)
#define TAUT_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define TAUT_INDEPENDENT _Pragma("GCC ivdep")
#else
#define TAUT_INDEPENDENT
#endif

/// LINES: elements first..end-1 in tiles of `group_size` (which make the lanes), each cut where a line ends.
/// The body is made once for the ends of a line and once for what lies between, so that the long loop has no
/// question in it; indices are as wide as pointers, so that it is seen to walk through memory.
template <uint group_size>
class Lines
{
public:
    Lines(uint first, uint end, uint length)
        : line(first / length),
          length_(length),
          end_(end),
          i_(first),
          tile_(first),
          behind_((std::size_t{line} + 1) * length)
    {}

    bool more() const { return i_ < end_; }

    /// The rest of line and tile, whichever is shorter. `body` is told what holds in types, so that every
    /// answer makes its own code.
    template <typename Body>
    void each(bool inside, Body body)
    {
        if (inside)
            run(body, std::true_type{});
        else
            run(body, std::false_type{});
    }

    uint line;

private:
    template <typename Body, typename Inside>
    void run(Body& body, Inside inside)
    {
        constexpr std::true_type yes;
        constexpr std::false_type no;
        const std::size_t tile_end = end_ - tile_ < group_size ? end_ : tile_ + group_size;
        const std::size_t stop = tile_end < behind_ ? tile_end : behind_;
        const std::size_t last = stop < behind_ ? stop : behind_ - 1; // of what is inside of the line
        std::size_t i = i_;
        if (length_ == 1)
            body(i, i - tile_, yes, yes, inside);
        else
        {
            if (i + length_ == behind_)
            {
                body(i, i - tile_, yes, no, inside);
                ++i;
            }
            TAUT_INDEPENDENT
            for (; i < last; ++i)
                body(i, i - tile_, no, no, inside);
            if (i < stop)
                body(i, i - tile_, no, yes, inside);
        }
        i_ = stop;
        tile_ = stop == tile_end ? stop : tile_;
        if (stop == behind_)
        {
            ++line;
            behind_ += length_;
        }
    }

    std::size_t length_, end_, i_, tile_;
    std::size_t behind_; ///< the first element of the next line
};

/// Where a loop reads several streams, or short pieces of them, the processor's own guesses end with every
/// page. By number: a pointer past the end must not be made.
template <typename T>
void prefetch(const T* buffer, std::size_t index)
{
    __builtin_prefetch(
        reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(buffer) + index * sizeof(T)));
}

/// The order of the sum is fixed, so only the products can share an instruction. Left to itself the compiler
/// makes none of it, or four products that it takes apart again at a higher price.
template <typename T>
T add_two(T sum, const T* a, T b0, T b1)
{
#if defined(__GNUC__)
    typedef T Two __attribute__((vector_size(2 * sizeof(T)))); // with `using` GCC 12 drops the attribute
    Two both;
    std::memcpy(&both, a, sizeof(both));
    const Two products = both * Two{b0, b1};
    return (sum + products[0]) + products[1];
#else
    return (sum + a[0] * b0) + a[1] * b1;
#endif
}

/// A product of floats is exact in double: high is what float makes of it, low the rest. False: nothing is
/// wider.
inline bool wider_product(float a, float b, float& high, float& low)
{
    const double exact = static_cast<double>(a) * static_cast<double>(b);
    high = static_cast<float>(exact);
    low = static_cast<float>(exact - static_cast<double>(high));
    return true;
}
inline bool wider_product(double, double, double&, double&) { return false; }

inline std::uint32_t count_event(std::uint32_t& counter)
{
    return std::atomic_ref<std::uint32_t>(counter).fetch_add(1, std::memory_order_relaxed);
}

} // namespace taut::native

#define INOUT(T) T&
#define PRECISE
#define IS_FINITE(value) std::isfinite(value)
#define DECLARE(prototype)
#define APART [[gnu::noinline]]
#define INLINE [[gnu::always_inline]] inline
#define LAYOUT_STRUCT(name) struct name
#define REAL(x) real(x)
#define ELEMENT uint
#define SELECT(condition, a, b) ((condition) ? (a) : (b))
#define ANY(condition) (condition)

#define PARAMS struct
#define READ(slot, T, name) const T* __restrict name
#define READ_ONE(slot, T, name) taut::native::One<T> name
#define WRITE(slot, T, name) T* __restrict name
#define UPDATE(slot, T, name) T* __restrict name
#define GROUP_UPDATE(slot, T, name) T* __restrict name
#define COUNTERS(slot, name) std::uint32_t* __restrict name
#define SHARED(T, name, n) T name[n]
#define COUNT_EVENT(buffer, index) taut::native::count_event(buffer[index])
#define NEXT_EVENT(buffer, index) taut::native::count_event(buffer[index])
#define COUNT_EVENT_IF(condition, buffer, index)                                                             \
    do                                                                                                       \
        if (condition)                                                                                       \
            COUNT_EVENT(buffer, index);                                                                      \
    while (false)
#define WIDER_PRODUCT(a, b, high, low) taut::native::wider_product(a, b, high, low)
#define ADD_TWO(sum, a, k, b0, b1) sum = taut::native::add_two(sum, a + (k), b0, b1)
#define PREFETCH(buffer, index) taut::native::prefetch(buffer, index)
#define WIDE std::size_t

#define KERNEL(count)                                                                                        \
    std::uint32_t element_count() const { return std::uint32_t(count); }                                     \
    void element(const uint i)

#define GROUP_KERNEL(size)                                                                                   \
    static constexpr std::uint32_t taut_group_size = size;                                                   \
    void body(const uint group)

#define PHASE_BEGIN                                                                                          \
    for (uint lane = 0; lane < taut_group_size; ++lane)                                                      \
    {
#define PHASE_END }

#define LANES_BEGIN(n)                                                                                       \
    TAUT_INDEPENDENT                                                                                         \
    for (uint lane = 0; lane < uint(n); ++lane)                                                              \
    {
#define LANES_END }

// Tiles of one group's size: lane k of a tile is its k-th element, as on a device. `i` is wider than uint so
// that the compiler sees neighbours: a sum of two uints might wrap.
#define EACH_BEGIN(first, end)                                                                               \
    for (std::size_t taut_tile = uint(first); taut_tile < uint(end); taut_tile += taut_group_size)           \
    {                                                                                                        \
        const std::size_t taut_rest = uint(end) - taut_tile;                                                 \
        const uint taut_lanes = taut_rest < taut_group_size ? uint(taut_rest) : taut_group_size;             \
        TAUT_INDEPENDENT                                                                                     \
        for (uint lane = 0; lane < taut_lanes; ++lane)                                                       \
        {                                                                                                    \
            const std::size_t i = taut_tile + lane;
#define EACH_END                                                                                             \
    }                                                                                                        \
    }

#define LINES_BEGIN(first, end, length)                                                                      \
    for (taut::native::Lines<taut_group_size> taut_lines{first, end, length}; taut_lines.more();)            \
    {                                                                                                        \
        const uint line = taut_lines.line;
#define LINE_BEGIN(inside)                                                                                   \
    taut_lines.each(inside, [&](const std::size_t i, const std::size_t lane, const auto line_first, \
                                const auto line_last, const auto line_inside) {
#define LINE_END                                                                                             \
    });
#define LINES_END }

// A slice at a time; `r` is wide for the same reason as `i` of EACH.
#define SLICES_BEGIN(first, end)                                                                             \
    for (uint slice = uint(first); slice < uint(end); ++slice)                                               \
    {                                                                                                        \
        const uint taut_lane = (slice - uint(first)) % (taut_group_size / 32u) * 32u;
#define PER_ROW(T, name) T name[32]
#define ROW(name) name[r]
#define TAUT_SLICE_ROWS                                                                                      \
    TAUT_INDEPENDENT                                                                                         \
    for (std::size_t r = 0; r < 32; ++r)                                                                     \
    {                                                                                                        \
        [[maybe_unused]] const std::size_t lane = taut_lane + r;
#define SLICE_ROWS_BEGIN TAUT_SLICE_ROWS
#define SLICE_ROWS_END }
#define SLICE_STEPS_BEGIN(n)                                                                                 \
    for (uint k = 0, taut_steps = uint(n); k < taut_steps; ++k)                                              \
    {                                                                                                        \
        TAUT_SLICE_ROWS
#define SLICE_STEPS_END                                                                                      \
    }                                                                                                        \
    }
#define SLICES_END }
