#include "taut/world/beside.hpp"

#include <chrono>
#include <utility>

namespace taut {
namespace {

/// As long as a part of a step may take, so that nobody is woken by the system within one.
constexpr std::chrono::microseconds kLook{500};

} // namespace

Beside::~Beside()
{
    turn_to(ended);
    thread_.join();
}

void Beside::turn_to(Turn next)
{
    turn_.store(next);
    turn_.notify_all();
}

void Beside::await(int present)
{
    const auto end = std::chrono::steady_clock::now() + kLook;
    while (turn_.load() == present && std::chrono::steady_clock::now() < end)
        std::this_thread::yield(); // somebody else may need the core
    turn_.wait(present);
}

void Beside::start(std::function<void()> job)
{
    job_ = std::move(job);
    turn_to(asked);
}

void Beside::finish()
{
    await(asked);
    turn_.store(idle);
    if (error_)
        std::rethrow_exception(std::exchange(error_, nullptr));
}

void Beside::work()
{
    for (;;)
    {
        const int now = turn_.load();
        if (now == ended)
            return;
        if (now != asked)
        {
            await(now);
            continue;
        }
        try
        {
            job_();
        }
        catch (...)
        {
            error_ = std::current_exception();
        }
        int expected = asked; // else the owner is gone
        if (turn_.compare_exchange_strong(expected, done))
            turn_.notify_all();
    }
}

} // namespace taut
