#pragma once
// The floating-point environment that kernels run in on a processor: denormals are zero, rounding is to
// nearest.
//
// Based on: Intel SDM volume 1, 10.2.3 (MXCSR: DAZ, FTZ, RC); Arm ARM, FPCR (FZ, RMode).
// Departures: on other processors nothing is set.

#include <cstdint>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace taut {

/// While it lives, operations of the calling thread take denormals for zero and make none, and round to
/// nearest; afterwards what the caller had is back. Threads that start meanwhile inherit it (POSIX,
/// pthread_create), those of software drivers among them: some set it themselves, some do not, GPUs mostly
/// do. So results depend neither on the driver nor on what the host program has set (as -ffast-math does).
class FlushDenormals
{
public:
    FlushDenormals() : before_(get()) { set((before_ & ~kRounding) | kFlush); }
    ~FlushDenormals() { set(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__SSE2__)
    using State = unsigned;
    static constexpr State kFlush = 0x8040u, kRounding = 0x6000u;
    static State get() { return _mm_getcsr(); }
    static void set(State state) { _mm_setcsr(state); }
#elif defined(__aarch64__)
    using State = std::uint64_t;
    static constexpr State kFlush = State{1} << 24, kRounding = State{3} << 22;
    static State get()
    {
        State state;
        asm volatile("mrs %0, fpcr" : "=r"(state));
        return state;
    }
    static void set(State state) { asm volatile("msr fpcr, %0" : : "r"(state)); }
#else
    using State = unsigned;
    static constexpr State kFlush = 0, kRounding = 0;
    static State get() { return 0; }
    static void set(State) {}
#endif
    State before_;
};

} // namespace taut
