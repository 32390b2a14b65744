#include "conditions.hpp"

#include "taut/runtime/device.hpp"
#include "taut/version.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

namespace bench {

std::string processor() { return taut::Device::open("cpu:serial")->info().name; }

namespace {

/// Spins; where the other thread does not get a core, it lets go of this one.
void await(const std::atomic<int>& line, int number)
{
    for (int spins = 0; line.load(std::memory_order_acquire) != number; ++spins)
        if (spins > 10'000)
            std::this_thread::yield();
}

} // namespace

double line_round_trip()
{
    constexpr int kTrips = 2000, kTurns = 9;
    std::atomic<int> line = 0;
    // The other thread answers an odd number with the even one behind it.
    std::thread other([&line] {
        for (int answer = 2; answer <= 2 * kTrips * kTurns; answer += 2)
        {
            await(line, answer - 1);
            line.store(answer, std::memory_order_release);
        }
    });
    double best = 1e30;
    for (int turn = 0, number = 0; turn < kTurns; ++turn)
    {
        const auto start = std::chrono::steady_clock::now();
        for (int trip = 0; trip < kTrips; ++trip)
        {
            line.store(++number, std::memory_order_release);
            await(line, number + 1);
            ++number;
        }
        const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
        best = std::min(best, took.count() / kTrips);
    }
    other.join();
    return best;
}

std::string conditions(const std::string& program, int argc, char** argv)
{
    std::string text = "taut " TAUT_VERSION "; devices:";
    for (const taut::DeviceInfo& device : taut::Device::list())
        text += " " + device.selector + " = " + device.name + " (" + device.driver + "),";
    text.back() = ';';
#if defined(__clang__)
    text += " compiler: clang " __clang_version__;
#else
    text += " compiler: g++ " __VERSION__;
#endif
    text += "; CPU: " + processor() + "; a cache line to another core and back: ";
    text += std::thread::hardware_concurrency() > 1 ? std::to_string(std::lround(line_round_trip())) + " ns"
                                                    : "-";
    text += "; command: " + program; // not the folder that it lies in
    for (int i = 1; i < argc; ++i)
        text += std::string(" ") + argv[i];
    return text;
}

std::vector<std::uint32_t> sides(int argc, char** argv, int first, std::vector<std::uint32_t> otherwise)
{
    std::vector<std::uint32_t> out;
    for (int k = first; k < argc; ++k)
    {
        std::uint32_t n = 0;
        const char* end = argv[k] + std::strlen(argv[k]);
        const auto [stop, code] = std::from_chars(argv[k], end, n);
        if (code != std::errc() || stop != end || n < 2 || n > 512)
            throw std::runtime_error("\"" + std::string(argv[k]) +
                                     "\" is no number of vertices a side; write 2 to 512");
        out.push_back(n);
    }
    return out.empty() ? std::move(otherwise) : out;
}

} // namespace bench
