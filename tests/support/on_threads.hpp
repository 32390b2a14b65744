#pragma once
// Several threads that do one thing. Catch2's assertions belong to one thread: work hands its findings over.

#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace taut {

inline unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls `work` on `count` threads and waits for all; throws what the first of them threw.
inline void on_threads(unsigned count, const std::function<void()>& work)
{
    std::exception_ptr thrown;
    std::mutex mutex;
    std::vector<std::thread> threads;
    for (unsigned k = 0; k < count; ++k)
        threads.emplace_back([&] {
            try
            {
                work();
            }
            catch (...)
            {
                const std::lock_guard lock(mutex);
                thrown = thrown ? thrown : std::current_exception();
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    if (thrown)
        std::rethrow_exception(thrown);
}

} // namespace taut
