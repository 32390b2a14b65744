#pragma once
// Measuring: rivals take turns, so that a disturbance hits all of them.

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace bench {

/// A row of the result table. `error` is what the time bought: a difference to the reference result.
struct Row
{
    std::string what;
    double milliseconds = 0; ///< median
    double best = 0;
    double error = 0;     ///< m
    double ratio = 0;     ///< to the row it is compared with
    std::string against;
    double target = 0;    ///< the ratio to reach; 0 = none
};

struct Rival
{
    std::string name;
    std::function<void()> run;
    std::vector<double> milliseconds = {};

    double best() const { return *std::min_element(milliseconds.begin(), milliseconds.end()); }
    double median() const
    {
        std::vector<double> sorted = milliseconds;
        std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2), sorted.end());
        return sorted[sorted.size() / 2];
    }
};

/// Median over the turns of a's time to b's in the same turn: what disturbs both does not count.
inline double paired_ratio(const Rival& a, const Rival& b)
{
    Rival ratio{"", {}, a.milliseconds};
    for (std::size_t i = 0; i < ratio.milliseconds.size(); ++i)
        ratio.milliseconds[i] /= b.milliseconds[i];
    return ratio.median();
}

/// Some turns to warm up, then `turns` turns in which every rival runs once.
inline void take_turns(std::vector<Rival>& rivals, int turns, int warm_up = 3)
{
    for (int turn = -warm_up; turn < turns; ++turn)
        for (Rival& rival : rivals)
        {
            const auto from = std::chrono::steady_clock::now();
            rival.run();
            const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - from;
            if (turn >= 0)
                rival.milliseconds.push_back(took.count());
        }
}

/// As take_turns, for rivals with threads of their own that spin on after their turn (libgomp's for some
/// milliseconds), on cores that the next rival wants: every turn begins with a rest in which they fall
/// asleep, and with a run that is not timed, which wakes the rival's own; five runs are timed then.
inline constexpr int kRunsOfTurn = 6;
inline void take_turns_rested(std::vector<Rival>& rivals, int turns, int warm_up)
{
    for (int turn = -warm_up; turn < turns; ++turn)
        for (Rival& rival : rivals)
        {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            for (int i = 0; i < kRunsOfTurn; ++i)
            {
                const auto from = std::chrono::steady_clock::now();
                rival.run();
                const std::chrono::duration<double, std::milli> took =
                    std::chrono::steady_clock::now() - from;
                if (turn >= 0 && i > 0)
                    rival.milliseconds.push_back(took.count());
            }
        }
}

/// Throws std::runtime_error when a rival's result is further than kLargestError from the reference's: what
/// computes something else is not timed.
inline constexpr double kLargestError = 1e-6; // m
std::vector<Row> distance_rows();
std::vector<Row> recording_rows();
std::vector<Row> cloth_rows();     ///< whole steps against a plain coloured OpenMP program
std::vector<Row> opencloth_rows(); ///< opencloth's position-based scene against a plain serial loop
std::vector<Row> solid_rows();     ///< a box of tetrahedra against a plain coloured OpenMP program
/// The same box until it rests: block descent against XPBD. TAUT_BENCH_CELLS: cells a side, else 16.
std::vector<Row> solid_static_rows();

} // namespace bench
