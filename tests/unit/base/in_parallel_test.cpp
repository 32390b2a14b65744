// Parts of one work on all cores: each once, and what they throw.

#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/in_parallel.hpp"

#include <algorithm>
#include <atomic>
#include <vector>

using namespace taut;

TEST_CASE("every part of a work is done once")
{
    const std::uint32_t count = GENERATE(0u, 1u, 2u, 10007u);
    std::vector<int> times(count, 0);
    in_parallel(count, [&](std::uint32_t k) { ++times[k]; });
    CHECK(std::count(times.begin(), times.end(), 1) == count);
}

TEST_CASE("what a part throws is thrown on, and the parts after it are not begun")
{
    std::atomic<std::uint32_t> begun = 0;
    const auto part = [&](std::uint32_t k) {
        ++begun;
        if (k >= 5)
            throw Error(ErrorCode::limit, "too much");
    };
    CHECK_THROWS_WITH(in_parallel(100000000u, part), "too much");
    CHECK(begun < 1000000u);
}
