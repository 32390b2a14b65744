// Based on: Saad. Iterative Methods for Sparse Linear Systems, 2nd ed. 2003, algorithm 9.1.
// Departures: fused by hand into three loops an iteration: p = D^-1 r + beta p; q = A p and p.q;
//   x += alpha p, r -= alpha q, r.D^-1 r and r.r. What a programmer would write for one machine: no checks.

#include "linear_bench.hpp"

#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

namespace bench {
namespace {

/// Threads that meet: they spin, and give way after a while.
class Meeting
{
public:
    explicit Meeting(int threads) : threads_(threads) {}

    void wait()
    {
        const int round = round_.load(std::memory_order_acquire);
        if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_)
        {
            arrived_.store(0, std::memory_order_relaxed);
            round_.store(round + 1, std::memory_order_release);
            return;
        }
        for (int spins = 0; round_.load(std::memory_order_acquire) == round; ++spins)
            if (spins > 20000)
                std::this_thread::yield();
    }

private:
    const int threads_;
    std::atomic<int> arrived_ = 0;
    std::atomic<int> round_ = 0;
};

struct alignas(64) Sums
{
    double curvature = 0, rz = 0, rr = 0;
};

class Plain : public Solver
{
public:
    Plain(const System& system, int threads) : system_(system), threads_(threads)
    {
        const auto& a = system.a;
        inverse_.resize(a.rows);
        for (std::uint32_t i = 0; i < a.rows; ++i)
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
                if (a.column[k] == i)
                    inverse_[i] = 1 / a.value[k];
        for (std::vector<double>* v : {&x_, &r_, &p_, &q_})
            v->assign(a.rows, 0.0);
    }

    int solve(double tolerance, int limit) override
    {
        tolerance_ = tolerance;
        limit_ = limit;
        on_all([this](int thread) { iterate(thread); });
        return taken_;
    }
    bool product() override
    {
        on_all([this](int thread) {
            const auto [first, last] = share(thread);
            multiply(first, last, system_.b.data());
        });
        return true;
    }
    std::vector<double> x() override { return x_; }
    std::vector<double> y() override { return q_; }

private:
    template <typename Job>
    void on_all(Job job)
    {
        std::vector<std::thread> others;
        for (int thread = 1; thread < threads_; ++thread)
            others.emplace_back(job, thread);
        job(0);
        for (std::thread& other : others)
            other.join();
    }

    std::pair<std::uint32_t, std::uint32_t> share(int thread) const
    {
        const std::uint64_t rows = system_.a.rows, of = static_cast<std::uint64_t>(threads_);
        const auto t = static_cast<std::uint64_t>(thread);
        return {static_cast<std::uint32_t>(rows * t / of), static_cast<std::uint32_t>(rows * (t + 1) / of)};
    }

    double multiply(std::uint32_t first, std::uint32_t last, const double* p)
    {
        const std::uint32_t* const start = system_.a.row_start.data();
        const std::uint32_t* const column = system_.a.column.data();
        const double* const value = system_.a.value.data();
        double curvature = 0;
        for (std::uint32_t i = first; i < last; ++i)
        {
            double sum = 0;
            for (std::uint32_t k = start[i]; k < start[i + 1]; ++k)
                sum += value[k] * p[column[k]];
            q_[i] = sum;
            curvature += p[i] * sum;
        }
        return curvature;
    }

    Sums meet(int thread, const Sums& mine, std::vector<Sums>& sums)
    {
        sums[static_cast<std::size_t>(thread)] = mine;
        meeting_.wait();
        Sums all;
        for (const Sums& s : sums)
        {
            all.curvature += s.curvature;
            all.rz += s.rz;
            all.rr += s.rr;
        }
        return all;
    }

    void iterate(int thread)
    {
        const auto [first, last] = share(thread);
        double *const x = x_.data(), *const r = r_.data(), *const p = p_.data();
        const double *const q = q_.data(), *const inverse = inverse_.data(), *const b = system_.b.data();
        Sums mine;
        for (std::uint32_t i = first; i < last; ++i)
        {
            x[i] = p[i] = 0;
            r[i] = b[i];
            mine.rz += r[i] * inverse[i] * r[i];
            mine.rr += r[i] * r[i];
        }
        Sums now = meet(thread, mine, after_);
        const double goal = tolerance_ * tolerance_ * now.rr;
        double beta = 0;
        int k = 0;
        for (; k < limit_ && now.rr > goal; ++k)
        {
            for (std::uint32_t i = first; i < last; ++i)
                p[i] = inverse[i] * r[i] + beta * p[i];
            meeting_.wait();
            const double alpha = now.rz / meet(thread, {multiply(first, last, p), 0, 0}, before_).curvature;
            double rz = 0, rr = 0;
            for (std::uint32_t i = first; i < last; ++i)
            {
                x[i] += alpha * p[i];
                const double rest = r[i] - alpha * q[i];
                r[i] = rest;
                rz += rest * inverse[i] * rest;
                rr += rest * rest;
            }
            const Sums next = meet(thread, {0, rz, rr}, after_);
            beta = next.rz / now.rz;
            now = next;
        }
        if (thread == 0)
            taken_ = k;
    }

    const System& system_;
    const int threads_;
    std::vector<double> inverse_, x_, r_, p_, q_;
    Meeting meeting_{threads_};
    std::vector<Sums> before_ = std::vector<Sums>(static_cast<std::size_t>(threads_));
    std::vector<Sums> after_ = std::vector<Sums>(static_cast<std::size_t>(threads_));
    double tolerance_ = 0;
    int limit_ = 0, taken_ = 0;
};

} // namespace

std::unique_ptr<Solver> plain_solver(const System& system, int threads)
{
    return std::make_unique<Plain>(system, threads);
}

void parallel_copy(void* to, const void* from, std::size_t bytes, int threads)
{
    const auto copy = [&](std::size_t thread) {
        const std::size_t first = bytes * thread / static_cast<std::size_t>(threads);
        const std::size_t last = bytes * (thread + 1) / static_cast<std::size_t>(threads);
        std::memcpy(static_cast<char*>(to) + first, static_cast<const char*>(from) + first, last - first);
    };
    std::vector<std::thread> others;
    for (int thread = 1; thread < threads; ++thread)
        others.emplace_back(copy, thread);
    copy(0);
    for (std::thread& other : others)
        other.join();
}

} // namespace bench
