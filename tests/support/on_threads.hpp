#pragma once
// Several threads that do one thing. Catch2's assertions belong to one thread: work hands its findings over.

#include "taut/runtime/base/in_parallel.hpp"

#include <algorithm>
#include <functional>
#include <thread>

namespace taut {

inline unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls `work` `count` times, at once on as many threads as there are processors, and waits for all; throws
/// what the first of them threw.
inline void on_threads(unsigned count, const std::function<void()>& work)
{
    in_parallel(count, [&](std::uint32_t) { work(); });
}

} // namespace taut
