#pragma once
// Ctrl-C as a question that a loop can ask.

namespace taut::cli {

/// While one of these lives, the first SIGINT or SIGTERM only sets a flag; a second one ends the process.
class InterruptGuard
{
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;
    bool interrupted() const;
};

} // namespace taut::cli
