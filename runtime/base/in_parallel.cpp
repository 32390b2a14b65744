#include "taut/runtime/base/in_parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace taut {
namespace {

class Parts
{
public:
    Parts(std::uint32_t count, const std::function<void(std::uint32_t)>& part) : count_(count), part_(part) {}

    /// Until none is left.
    void work()
    {
        try
        {
            for (std::uint64_t k = next_++; k < count_; k = next_++)
                part_(static_cast<std::uint32_t>(k));
        }
        catch (...)
        {
            const std::lock_guard lock(guard_);
            failure_ = failure_ ? failure_ : std::current_exception();
            next_ = count_; // nobody begins another one
        }
    }

    void rethrow() const
    {
        if (failure_)
            std::rethrow_exception(failure_);
    }

private:
    const std::uint64_t count_;
    const std::function<void(std::uint32_t)>& part_;
    std::atomic<std::uint64_t> next_ = 0;
    std::mutex guard_;
    std::exception_ptr failure_;
};

} // namespace

void in_parallel(std::uint32_t count, const std::function<void(std::uint32_t)>& part)
{
    Parts parts(count, part);
    std::vector<std::jthread> others;
    try
    {
        const std::uint32_t wanted = std::min(count, std::max(1u, std::thread::hardware_concurrency()));
        while (others.size() + 1 < wanted)
            others.emplace_back([&parts] { parts.work(); });
    }
    catch (const std::system_error&)
    {} // the system gives no more threads: those that there are do it
    parts.work();
    others.clear(); // waits for them
    parts.rethrow();
}

} // namespace taut
