#pragma once
// Internal to src/world: a thread that does one thing at a time beside its owner.

#include <atomic>
#include <exception>
#include <functional>
#include <thread>

namespace taut {

/// For work of some microseconds: who waits looks again and again for a while before it sleeps. One owner.
class Beside
{
public:
    Beside() : thread_([this] { work(); }) {}
    ~Beside();
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;

    /// Starts `job`. Every start is followed by one finish.
    void start(std::function<void()> job);
    /// Waits for it. Throws what it threw.
    void finish();

private:
    enum Turn : int
    {
        idle,
        asked,
        done,
        ended
    };

    void work();
    void await(int present); ///< until the turn is no longer `present`
    void turn_to(Turn next);

    std::atomic<int> turn_{idle};
    std::function<void()> job_;
    std::exception_ptr error_;
    std::thread thread_; ///< last: it uses the others
};

} // namespace taut
