#include "taut/runtime/cpu/pool.hpp"

#include "taut/runtime/base/flush_denormals.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <system_error>
#include <utility>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

namespace taut::cpu {
namespace {

using Clock = std::chrono::steady_clock;

/// Long enough to bridge the gap between two passes, short enough that a core which somebody else needs
/// is not burnt.
constexpr std::chrono::microseconds kSpin{15};

constexpr unsigned kField = 24;
constexpr std::uint64_t kFieldMask = (std::uint64_t{1} << kField) - 1;

std::uint32_t front_of(std::uint64_t ticket)
{
    return static_cast<std::uint32_t>(ticket >> kField & kFieldMask);
}
std::uint32_t back_of(std::uint64_t ticket) { return static_cast<std::uint32_t>(ticket & kFieldMask); }

void relax()
{
#if defined(__x86_64__) || defined(__i386__)
    _mm_pause();
#elif defined(__aarch64__)
    asm volatile("yield");
#endif
}

/// Spins until done() or until kSpin is over; returns done().
template <typename Done>
bool spin_until(Done&& done)
{
    if (done())
        return true;
    const Clock::time_point end = Clock::now() + kSpin;
    do
    {
        for (int i = 0; i < 16; ++i)
        {
            if (done())
                return true;
            relax();
        }
    } while (Clock::now() < end);
    return done();
}

double nanoseconds(Clock::duration time) { return std::chrono::duration<double, std::nano>(time).count(); }

} // namespace

Pool::Pool(unsigned workers)
{
    threads_.reserve(workers);
    try
    {
        for (unsigned i = 0; i < workers; ++i)
            threads_.emplace_back([this] { work(); });
    }
    catch (const std::system_error&)
    {
        // No more threads to be had: the results are the same with fewer.
    }
}

Pool::~Pool()
{
    stop_.store(true);
    bell_.fetch_add(1);
    bell_.notify_all();
    for (std::thread& thread : threads_)
        thread.join();
}

// ---------------------------------------------------------------- chunks

bool Pool::has_work() const
{
    const std::uint64_t ticket = ticket_.load();
    return front_of(ticket) < back_of(ticket);
}

std::optional<std::uint32_t> Pool::claim(bool from_front)
{
    std::uint64_t ticket = ticket_.load(std::memory_order_acquire);
    while (front_of(ticket) < back_of(ticket))
    {
        const std::uint64_t next = from_front ? ticket + (std::uint64_t{1} << kField) : ticket - 1;
        if (ticket_.compare_exchange_weak(ticket, next, std::memory_order_acq_rel, std::memory_order_acquire))
            return from_front ? front_of(ticket) : back_of(ticket) - 1;
    }
    return std::nullopt;
}

void Pool::run_chunk(std::uint32_t chunk)
{
    try
    {
        job_->run_chunk(chunk);
    }
    catch (...)
    {
        const std::lock_guard lock(error_mutex_);
        if (!error_)
            error_ = std::current_exception();
    }
}

// ---------------------------------------------------------------- the worker

void Pool::work()
{
    const FlushDenormals flushed;
    do
    {
        while (const auto chunk = claim(false))
        {
            run_chunk(*chunk);
            finished_.fetch_add(1, std::memory_order_release);
            finished_.notify_one(); // a system call only if the caller sleeps
        }
    } while (await_work());
}

bool Pool::await_work()
{
    if (!spin_until([this] { return has_work() || stop_.load(); }))
    {
        // Either the caller sees this sleeper after it published, or this thread sees the work.
        const std::uint32_t bell = bell_.load();
        sleepers_.fetch_add(1);
        if (!has_work() && !stop_.load())
            bell_.wait(bell);
        sleepers_.fetch_sub(1);
    }
    return !stop_.load();
}

// ---------------------------------------------------------------- the caller

/// Chunk 0 is claimed already. A plain store lets the caller begin at once. A worker that is just falling
/// asleep may miss it: then the caller does more itself, or finds the sleeper after its first chunk.
void Pool::publish(Job& job, std::uint32_t chunks)
{
    if (job_ != &job)
        job_ = &job;
    finished_.store(0, std::memory_order_relaxed);
    const std::uint64_t number = (ticket_.load(std::memory_order_relaxed) >> (2 * kField)) + 1;
    ticket_.store(number << (2 * kField) | std::uint64_t{1} << kField | chunks, std::memory_order_release);
}

double Pool::wake(std::uint32_t useful)
{
    const std::uint32_t sleepers = sleepers_.load(std::memory_order_relaxed);
    if (sleepers == 0 || useful == 0)
        return 0;
    const Clock::time_point begin = Clock::now();
    bell_.fetch_add(1);
    if (useful >= sleepers)
        bell_.notify_all();
    else
        for (std::uint32_t i = 0; i < useful; ++i)
            bell_.notify_one();
    return nanoseconds(Clock::now() - begin);
}

double Pool::await_workers(std::uint32_t claimed)
{
    const auto done = [&] { return finished_.load(std::memory_order_acquire) == claimed; };
    if (done())
        return 0;
    const Clock::time_point begin = Clock::now();
    if (!spin_until(done))
        for (std::uint32_t seen = finished_.load(std::memory_order_acquire); seen != claimed;
             seen = finished_.load(std::memory_order_acquire))
            finished_.wait(seen, std::memory_order_acquire);
    return nanoseconds(Clock::now() - begin);
}

Pool::Outcome Pool::run(Job& job, std::uint32_t chunks)
{
    assert(chunks <= kMaxChunks);
    if (chunks == 0)
        return {};
    publish(job, chunks);
    double lost = wake(chunks - 1);
    run_chunk(0);
    std::uint32_t own = 1;
    for (auto chunk = claim(true); chunk; chunk = claim(true), ++own)
    {
        if (own == 1)
            lost += wake(back_of(ticket_.load(std::memory_order_relaxed)) - *chunk - 1);
        run_chunk(*chunk);
    }
    lost += await_workers(chunks - own);
    if (error_)
        std::rethrow_exception(std::exchange(error_, nullptr));
    return {chunks - own, lost};
}

} // namespace taut::cpu
