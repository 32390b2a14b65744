#pragma once
// Kernels of the tests, as native functions: what the executors do must not depend on a real kernel.

#include "taut/runtime/base/kernel_info.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace taut::local {

struct CountParams
{
    std::uint32_t count = 0;
};

template <std::size_t N>
KernelInfo make_kernel(std::string_view name, const std::array<BindingInfo, N>& bindings, NativeKernel native)
{
    KernelInfo info;
    info.name = name;
    info.param_bytes = sizeof(CountParams);
    info.bindings = bindings;
    info.native = native;
    return info;
}

template <typename T>
T* buffer(void* const* buffers, int slot)
{
    return static_cast<T*>(buffers[slot]);
}

/// out[i] = 0.75 in[i] + 0.25 in[i + 1], cyclic: rounds, so that a wrong order shows.
inline void smooth_native(const void* params, void* const* buffers, std::uint32_t begin, std::uint32_t end)
{
    const std::uint32_t n = static_cast<const CountParams*>(params)->count;
    const float* in = buffer<const float>(buffers, 0);
    float* out = buffer<float>(buffers, 1);
    for (std::uint32_t i = begin; i < end && i < n; ++i)
        out[i] = 0.75f * in[i] + 0.25f * in[i + 1 == n ? 0 : i + 1];
}

/// One spring of a chain or list: pulls both ends together by a quarter of their distance.
inline void spring_native(const void* params, void* const* buffers, std::uint32_t begin, std::uint32_t end)
{
    const std::uint32_t n = static_cast<const CountParams*>(params)->count;
    const std::uint32_t* ends = buffer<const std::uint32_t>(buffers, 0);
    float* x = buffer<float>(buffers, 1);
    for (std::uint32_t i = begin; i < end && i < n; ++i)
    {
        float& a = x[ends[2 * i]];
        float& b = x[ends[2 * i + 1]];
        const float push = 0.25f * (b - a);
        a += push;
        b -= push;
    }
}

/// Counts how often every element ran, and all of them together in [count].
inline void tally_native(const void* params, void* const* buffers, std::uint32_t begin, std::uint32_t end)
{
    const std::uint32_t n = static_cast<const CountParams*>(params)->count;
    std::uint32_t* counters = buffer<std::uint32_t>(buffers, 0);
    for (std::uint32_t i = begin; i < end; ++i)
    {
        std::atomic_ref(counters[i < n ? i : n]).fetch_add(1, std::memory_order_relaxed);
        std::atomic_ref(counters[n]).fetch_add(1, std::memory_order_relaxed);
    }
}

inline const std::array kSmoothBindings = {BindingInfo{"in", 0, Access::read, 4},
                                           BindingInfo{"result", 1, Access::write, 4}};
inline const std::array kSpringBindings = {BindingInfo{"ends", 0, Access::read, 8},
                                           BindingInfo{"position", 1, Access::update, 4}};
inline const std::array kTallyBindings = {BindingInfo{"counters", 0, Access::count, 4}};

inline const KernelInfo kSmooth = make_kernel("smooth", kSmoothBindings, smooth_native);
inline const KernelInfo kSpring = make_kernel("spring", kSpringBindings, spring_native);
inline const KernelInfo kTally = make_kernel("tally", kTallyBindings, tally_native);

/// The same, dispatched by groups.
inline const KernelInfo kGroupTally = [] {
    KernelInfo info = kTally;
    info.name = "group_tally";
    info.group_kernel = true;
    return info;
}();

} // namespace taut::local
