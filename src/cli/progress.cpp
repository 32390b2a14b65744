#include "taut/cli/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace taut::cli {

Progress::Progress(std::uint64_t total) : total_(total), terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::update(std::uint64_t done)
{
    const auto now = Clock::now();
    if (!terminal_ || total_ == 0 || (drawn_ && now - last_ < std::chrono::milliseconds(100)))
        return;
    constexpr std::uint64_t kWidth = 30;
    const std::uint64_t filled = kWidth * done / total_;
    const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
    const double spent = std::chrono::duration<double>(now - start_).count();
    const double left =
        done == 0 ? 0 : spent / static_cast<double>(done) * static_cast<double>(total_ - done);
    std::fprintf(stderr, "\r[%s] %llu/%llu, %.0f s left \033[K", bar.c_str(),
                 static_cast<unsigned long long>(done), static_cast<unsigned long long>(total_), left);
    std::fflush(stderr);
    last_ = now;
    drawn_ = true;
}

void Progress::clear()
{
    if (drawn_)
        std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

} // namespace taut::cli
