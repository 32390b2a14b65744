#pragma once
// A dispatch with everything looked up: what the native executor runs.

#include "taut/runtime/base/dispatch.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace taut::cpu {

inline constexpr std::uint32_t kMaxBindings = 8;

/// Nanoseconds of one element, as far as they are known. Decides only how work is cut and shared, never
/// a result.
class ElementCost
{
public:
    explicit ElementCost(double guess = 10) : nanoseconds_(guess) {}

    double nanoseconds() const { return nanoseconds_; }

    /// Whether this run should be timed: the first few, then one in 16, since clocks cost time too.
    bool wants_sample() { return runs_++ < 4 || runs_ % 16 == 0; }

    /// A thread that lost its core makes a sample far too long; so growth is limited, and the next
    /// honest sample takes it back.
    void sample(double nanoseconds, std::uint32_t elements)
    {
        const double measured = std::max(nanoseconds / elements, 0.05); // a clock may stand still
        nanoseconds_ = measured_ ? std::min(measured, 2 * nanoseconds_) : measured;
        measured_ = true;
    }

private:
    double nanoseconds_;
    std::uint32_t runs_ = 0;
    bool measured_ = false;
};

/// What every thread reads lies apart from `cost`, which the caller's thread writes in every run.
struct alignas(64) Pass
{
    NativeKernel native = nullptr;
    const void* params = nullptr;
    const std::uint32_t* indirect = nullptr; ///< group counts x, y, z; null for a direct dispatch
    std::uint32_t count = 0;                 ///< elements or groups; the largest possible if indirect
    std::uint32_t per_group = 1;             ///< elements that one indirect group stands for
    ElementCost cost;
    alignas(64) std::array<void*, kMaxBindings> buffers{};

    /// Elements (or groups) to run now. Reads the indirect counts, so only after the barrier before.
    std::uint32_t elements() const
    {
        if (!indirect)
            return count;
        std::uint64_t run = per_group;
        for (int axis = 0; axis < 3; ++axis) // saturates: 32-bit factors cannot overflow 64 bits
            run = std::min<std::uint64_t>(run * indirect[axis], std::uint64_t{1} << 32);
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(run, count));
    }

    void run(std::uint32_t begin, std::uint32_t end) const { native(params, buffers.data(), begin, end); }
};

} // namespace taut::cpu
