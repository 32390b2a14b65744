#include "support/catch.hpp"
#include "taut/runtime/cpu/pool.hpp"

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace taut;

TEST_CASE("a pool runs every chunk of every job once, whatever the number of workers")
{
    struct Tally final : cpu::Job
    {
        std::vector<std::atomic<int>> runs = std::vector<std::atomic<int>>(200);
        void run_chunk(std::uint32_t chunk) override { ++runs[chunk]; }
    };
    for (const unsigned workers : {0u, 1u, 2u, 9u})
    {
        cpu::Pool pool(workers);
        CHECK(pool.workers() == workers);
        Tally tally;
        for (std::uint32_t job = 0; job < 5000; ++job)
            REQUIRE(pool.run(tally, job % 200).by_workers <= job % 200);
        bool all = true;
        for (std::uint32_t chunk = 0; chunk < 200; ++chunk)
            all = all && tally.runs[chunk] == 25 * static_cast<int>(199 - chunk);
        CHECK(all);
    }
}

TEST_CASE("the first chunk of a job is the caller's")
{
    struct Watcher final : cpu::Job
    {
        std::thread::id caller = std::this_thread::get_id();
        std::atomic<int> wrong = 0;
        void run_chunk(std::uint32_t chunk) override
        {
            wrong += chunk == 0 && std::this_thread::get_id() != caller;
        }
    };
    cpu::Pool pool(2);
    Watcher watcher;
    for (std::uint32_t job = 0; job < 2000; ++job)
        pool.run(watcher, 1 + job % 7);
    CHECK(watcher.wrong == 0);
}

TEST_CASE("what a chunk throws reaches the caller after all chunks stopped, and the pool lives on")
{
    struct Thrower final : cpu::Job
    {
        std::atomic<int> running = 0;
        void run_chunk(std::uint32_t chunk) override
        {
            ++running;
            if (chunk % 3 == 0)
            {
                --running;
                throw std::runtime_error("chunk");
            }
            --running;
        }
    };
    cpu::Pool pool(2);
    Thrower thrower;
    for (int i = 0; i < 100; ++i)
    {
        REQUIRE_THROWS_AS(pool.run(thrower, 16), std::runtime_error);
        REQUIRE(thrower.running == 0);
    }
}

TEST_CASE("pools come and go without work")
{
    for (int i = 0; i < 50; ++i)
        REQUIRE_NOTHROW(cpu::Pool(3));
}
