#pragma once
// Threads that share the chunks of one job at a time with the calling thread.
//
// The one rule: the caller waits only for chunks that a worker has begun. A worker that wakes late finds
// nothing left and delays nobody; so a core that is busy with something else costs at most one chunk.
//
// Chunks are claimed from one 64-bit ticket {job number : 16, front : 24, back : 24} by compare and
// swap. The caller takes from the front, workers from the back: over a run of passes on the same data
// each thread stays in its part of memory. A claim that succeeds is always one of the current job, and
// the caller does not publish the next job before every claimed chunk is finished; so a worker
// reads the job only after its claim.
//
// A job of a few microseconds costs two trips of a cache line each way: the first chunk is the caller's from
// the start, a job is published by a plain store, and the clock is read only where somebody waits.

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace taut::cpu {

/// Work cut into numbered chunks that may run at the same time, in any order.
class Job
{
public:
    virtual void run_chunk(std::uint32_t chunk) = 0;

protected:
    ~Job() = default;
};

inline constexpr std::uint32_t kMaxChunks = (1u << 24) - 1;

class Pool
{
public:
    /// Starts up to `workers` threads; fewer if the system gives no more.
    explicit Pool(unsigned workers);
    ~Pool();
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    unsigned workers() const { return static_cast<unsigned>(threads_.size()); }

    struct Outcome
    {
        std::uint32_t by_workers = 0; ///< chunks
        double lost_nanoseconds = 0;  ///< the caller's: spent waking workers and waiting for the last chunk
    };

    /// Runs chunks 0..chunks-1 (at most kMaxChunks) and returns when all are done. One caller at a time.
    /// Throws what a chunk threw, after all chunks have stopped.
    Outcome run(Job& job, std::uint32_t chunks);

private:
    void work();
    bool await_work(); ///< false: the pool ends
    bool has_work() const;
    std::optional<std::uint32_t> claim(bool from_front);
    void run_chunk(std::uint32_t chunk);
    void publish(Job& job, std::uint32_t chunks);
    double wake(std::uint32_t useful);           ///< ns that it took
    double await_workers(std::uint32_t claimed); ///< ns

    // One cache line for what changes hands in every job, others for what does not.
    alignas(64) std::atomic<std::uint64_t> ticket_{0};
    std::atomic<std::uint32_t> finished_{0};             ///< chunks of this job that workers finished
    alignas(64) std::atomic<std::uint32_t> bell_{0};     ///< rung to wake sleepers
    std::atomic<std::uint32_t> sleepers_{0};
    std::atomic<bool> stop_{false};
    alignas(64) Job* job_ = nullptr; ///< written only when it changes, so its line stays with everybody
    std::mutex error_mutex_;
    std::exception_ptr error_;
    std::vector<std::thread> threads_;
};

} // namespace taut::cpu
