#pragma once
// A progress bar on standard error, drawn only when that is a terminal.

#include <chrono>
#include <cstdint>

namespace taut::cli {

class Progress
{
public:
    explicit Progress(std::uint64_t total);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// At most ten lines a second are drawn, so that it costs nothing to call this every frame.
    void update(std::uint64_t done);
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    std::uint64_t total_;
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = {};
};

} // namespace taut::cli
