// Shares passes with a pool of threads when that pays, and notices when it does not.

#include "taut/runtime/cpu/pool.hpp"
#include "taut/runtime/cpu/runner.hpp"

#include <chrono>
#include <cmath>
#include <vector>

namespace taut::cpu {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kWorthSharing = 2'000;       ///< ns of work between two barriers below which nobody is asked
constexpr double kSmallestChunk = 1'000;      ///< ns; handing one over costs about 0.3 us
constexpr double kSpareChunk = 2'000;         ///< ns; claiming one more costs about 0.1 us
constexpr std::uint32_t kLeastElements = 128; ///< of a chunk of cheap elements
constexpr std::uint32_t kChunksPerThread = 4;
constexpr std::uint32_t kChunkMultiple = 16;  ///< elements; keeps the cuts off shared cache lines

/// Keeps the books on sharing. Time that the workers took off the caller is credit, time that the caller
/// spent waking them and waiting for them is debt. In debt the caller works alone for a while, as
/// it would with no workers at all: a busy machine costs at most 1/kPauseFactor of the time.
class Ledger
{
public:
    bool may_share(double work)
    {
        if (pause_ <= 0)
            return true;
        pause_ -= work;
        return false;
    }

    void settle(double saved, double lost)
    {
        credit_ = std::min(credit_ + saved - lost, kMostCredit);
        if (credit_ >= 0)
            return;
        pause_ = -credit_ * kPauseFactor;
        credit_ = 0;
    }

private:
    static constexpr double kPauseFactor = 8;
    static constexpr double kMostCredit = 3e6; ///< ns; good times long ago excuse little
    double credit_ = 0;                        ///< ns
    double pause_ = 0;                         ///< ns of work still to do alone
};

/// The chunks of the passes between two barriers.
class Shares final : public Job
{
public:
    /// Elements of every pass now; returns the estimated time of all [ns].
    double measure(std::span<Pass> passes)
    {
        shares_.clear();
        double work = 0;
        for (Pass& pass : passes)
        {
            const std::uint32_t elements = pass.elements();
            if (elements == 0)
                continue;
            shares_.push_back({&pass, elements, elements, 0});
            work += elements * pass.cost.nanoseconds();
        }
        return work;
    }

    /// Costs are sampled here alone: an element whose vertices another thread has moved costs more.
    void run_alone()
    {
        for (const Share& share : shares_)
        {
            if (!share.pass->cost.wants_sample())
            {
                share.pass->run(0, share.elements);
                continue;
            }
            const Clock::time_point start = Clock::now();
            share.pass->run(0, share.elements);
            share.pass->cost.sample(std::chrono::duration<double, std::nano>(Clock::now() - start).count(),
                                    share.elements);
        }
    }

    /// Cuts everything into chunks; returns how many. Too many passes for the ticket: 0.
    std::uint32_t cut(unsigned threads)
    {
        std::uint64_t chunks = 0;
        for (Share& share : shares_)
        {
            share.chunk = chunk_size(share, threads);
            share.first_chunk = static_cast<std::uint32_t>(chunks);
            chunks += (std::uint64_t{share.elements} + share.chunk - 1) / share.chunk;
            if (chunks > kMaxChunks)
                return 0;
        }
        return static_cast<std::uint32_t>(chunks);
    }

    void run_chunk(std::uint32_t chunk) override
    {
        const auto after =
            std::upper_bound(shares_.begin(), shares_.end(), chunk,
                             [](std::uint32_t c, const Share& s) { return c < s.first_chunk; });
        const Share& share = *(after - 1);
        const std::uint32_t begin = (chunk - share.first_chunk) * share.chunk;
        const std::uint32_t end = share.elements - begin > share.chunk ? begin + share.chunk : share.elements;
        share.pass->run(begin, end);
    }

private:
    struct Share
    {
        Pass* pass;
        std::uint32_t elements;
        std::uint32_t chunk; ///< elements of one
        std::uint32_t first_chunk;
    };

    /// Into how many chunks: one a thread, or several where they are long enough for the quick to help
    /// the slow.
    static double pieces(double nanoseconds, unsigned threads)
    {
        const double rounds = std::floor(nanoseconds / (kSpareChunk * threads));
        if (rounds >= 2)
            return threads * std::min<double>(rounds, kChunksPerThread);
        return std::clamp(std::floor(nanoseconds / kSmallestChunk), 1.0, static_cast<double>(threads));
    }

    static std::uint32_t chunk_size(const Share& share, unsigned threads)
    {
        const double cost = std::max(share.pass->cost.nanoseconds(), 0.01);
        const double exact = share.elements / pieces(share.elements * cost, threads);
        std::uint64_t size = static_cast<std::uint64_t>(std::ceil(exact));
        // One element of a work-group kernel or of a costly kernel may be a chunk of its own.
        if (cost * kLeastElements <= 2.5 * kSpareChunk)
            size = std::max<std::uint64_t>(size, kLeastElements);
        if (size >= kChunkMultiple)
            size = (size + kChunkMultiple - 1) / kChunkMultiple * kChunkMultiple;
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(size, share.elements));
    }

    std::vector<Share> shares_;
};

class ParallelRunner final : public Runner
{
public:
    explicit ParallelRunner(unsigned threads) : pool_(threads - 1) {}

    void run(std::span<Pass> passes, Way way) override
    {
        const double work = shares_.measure(passes);
        if (way == Way::alone || work < kWorthSharing || pool_.workers() == 0 || !ledger_.may_share(work))
            return shares_.run_alone();
        const std::uint32_t chunks = shares_.cut(pool_.workers() + 1);
        if (chunks < 2)
            return shares_.run_alone();
        const Pool::Outcome outcome = pool_.run(shares_, chunks);
        ledger_.settle(work * outcome.by_workers / chunks, outcome.lost_nanoseconds);
    }

private:
    Shares shares_;
    Ledger ledger_;
    Pool pool_; ///< last: its threads end before what they read
};

} // namespace

std::unique_ptr<Runner> make_parallel_runner(unsigned threads)
{
    if (threads <= 1)
        return make_serial_runner();
    return std::make_unique<ParallelRunner>(threads);
}

} // namespace taut::cpu
