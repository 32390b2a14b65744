#include "local_kernels.hpp"
#include "support/catch.hpp"
#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/device.hpp"

#include <atomic>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>

using namespace taut;
using local::CountParams;

namespace {

std::shared_ptr<Device> open(CpuMode mode, unsigned threads = 3, std::uint64_t seed = 1)
{
    OpenOptions options;
    options.threads = threads;
    options.seed = seed;
    return open_cpu(mode, options);
}

template <typename T>
BufferPtr upload(Device& device, const std::vector<T>& values)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(T), "test");
    device.write<T>(buffer, values);
    return buffer;
}

std::vector<float> random_floats(std::size_t n, unsigned seed)
{
    std::mt19937 random(seed);
    std::vector<float> values(n);
    for (float& value : values)
        value = static_cast<float>(random() % 100'000) * 1e-3f - 50;
    return values;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// A chain of n points; even springs, then odd ones: two colours.
struct Chain
{
    std::vector<std::uint32_t> even, odd;

    explicit Chain(std::uint32_t n)
    {
        for (std::uint32_t i = 0; i + 1 < n; ++i)
        {
            std::vector<std::uint32_t>& colour = i % 2 == 0 ? even : odd;
            colour.push_back(i);
            colour.push_back(i + 1);
        }
    }
};

std::uint32_t springs(const std::vector<std::uint32_t>& ends)
{
    return static_cast<std::uint32_t>(ends.size() / 2);
}

/// `sweeps` sweeps over both colours.
std::vector<float> relax_chain(Device& device, std::uint32_t n, int sweeps)
{
    const Chain chain(n);
    const BufferPtr even = upload(device, chain.even), odd = upload(device, chain.odd);
    const BufferPtr x = upload(device, random_floats(n, 3));
    Recorder recorder(device.shared_from_this());
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
        recorder.dispatch(local::kSpring, {even, x}, CountParams{springs(chain.even)}, springs(chain.even));
        recorder.dispatch(local::kSpring, {odd, x}, CountParams{springs(chain.odd)}, springs(chain.odd));
    }
    const auto recording = recorder.finish();
    CHECK(recording->barrier_count() == static_cast<std::size_t>(2 * sweeps - 1));
    recording->replay();
    return device.read<float>(x, n);
}

/// All springs of the chain in one dispatch, as if they were of one colour.
std::vector<float> relax_wrongly(Device& device, std::uint32_t n)
{
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        ends.insert(ends.end(), {i, i + 1});
    const BufferPtr list = upload(device, ends), x = upload(device, random_floats(n, 3));
    Recorder recorder(device.shared_from_this());
    recorder.dispatch(local::kSpring, {list, x}, CountParams{springs(ends)}, springs(ends));
    recorder.finish()->replay();
    return device.read<float>(x, n);
}

/// A random list over four buffers: sizes from 1 to 40,000, several independent dispatches between barriers.
std::vector<float> run_random_list(Device& device, unsigned seed)
{
    constexpr std::uint32_t kLength = 40'000;
    std::mt19937 random(seed);
    std::vector<BufferPtr> x;
    for (unsigned k = 0; k < 4; ++k)
        x.push_back(upload(device, random_floats(kLength, seed + k)));
    Recorder recorder(device.shared_from_this());
    for (int i = 0; i < 300; ++i)
    {
        const auto count = static_cast<std::uint32_t>(1 + random() % (random() % 3 == 0 ? kLength : 200));
        const std::size_t from = random() % 4;
        const std::size_t to = (from + 1 + random() % 3) % 4;
        recorder.dispatch(local::kSmooth, {x[from], x[to]}, CountParams{count}, count);
    }
    const auto recording = recorder.finish();
    for (int i = 0; i < 3; ++i)
        recording->replay();
    std::vector<float> all;
    for (const BufferPtr& buffer : x)
        for (const float value : device.read<float>(buffer, kLength))
            all.push_back(value);
    return all;
}

} // namespace

TEST_CASE("parallel gives the bits of serial")
{
    const auto serial = open(CpuMode::serial);
    const unsigned threads = GENERATE(1u, 2u, 3u, 8u);
    const auto parallel = open(CpuMode::parallel, threads);
    for (const std::uint32_t n : {3u, 4u, 64u, 65u, 1000u, 50'000u})
    {
        CAPTURE(threads, n);
        CHECK(same_bits(relax_chain(*serial, n, 5), relax_chain(*parallel, n, 5)));
    }
}

TEST_CASE("shuffled gives the bits of serial when nothing conflicts")
{
    const auto serial = open(CpuMode::serial);
    for (const std::uint64_t seed : {1u, 2u, 3u})
    {
        const auto shuffled = open(CpuMode::shuffled, 0, seed);
        for (const std::uint32_t n : {3u, 4u, 64u, 65u, 1000u})
            CHECK(same_bits(relax_chain(*serial, n, 5), relax_chain(*shuffled, n, 5)));
        CHECK(same_bits(run_random_list(*serial, 11), run_random_list(*shuffled, 11)));
    }
}

TEST_CASE("shuffled finds a planted wrong colour")
{
    const auto serial = open(CpuMode::serial);
    const auto shuffled = open(CpuMode::shuffled);
    CHECK_FALSE(same_bits(relax_wrongly(*serial, 1000), relax_wrongly(*shuffled, 1000)));
    // Every replay has a new order: a second run differs from the first.
    CHECK_FALSE(same_bits(relax_wrongly(*shuffled, 1000), relax_wrongly(*shuffled, 1000)));
    // The order follows from the seed alone.
    CHECK(same_bits(relax_wrongly(*open(CpuMode::shuffled, 0, 9), 1000),
                    relax_wrongly(*open(CpuMode::shuffled, 0, 9), 1000)));
    CHECK_FALSE(same_bits(relax_wrongly(*open(CpuMode::shuffled, 0, 9), 1000),
                          relax_wrongly(*open(CpuMode::shuffled, 0, 10), 1000)));
}

TEST_CASE("shuffled finds a planted missing barrier")
{
    // b = smooth(a), c = smooth(b): with the barrier taken away some replay runs them the other way round.
    const auto run = [](CpuMode mode, bool barrier) {
        const auto device = open(mode);
        RecordingDesc desc;
        desc.buffers = {upload(*device, random_floats(32, 1)), device->make_buffer(128, "b"),
                        device->make_buffer(128, "c")};
        const CountParams params{32};
        for (const std::uint32_t from : {0u, 1u})
        {
            Dispatch dispatch;
            dispatch.kernel = &local::kSmooth;
            dispatch.bindings = {{from, 0, 128}, {from + 1, 0, 128}};
            const auto bytes = std::as_bytes(std::span(&params, 1));
            dispatch.params.assign(bytes.begin(), bytes.end());
            dispatch.count = 32;
            desc.dispatches.push_back(dispatch);
        }
        desc.barrier_before = {false, barrier};
        const std::vector<BufferPtr> buffers = desc.buffers;
        const auto recording = device->compile(desc);
        std::vector<float> all;
        for (int i = 0; i < 16; ++i)
        {
            device->write<float>(buffers[1], std::vector<float>(32, 0.0f));
            recording->replay();
            for (const float value : device->read<float>(buffers[2], 32))
                all.push_back(value);
        }
        return all;
    };
    CHECK(same_bits(run(CpuMode::serial, true), run(CpuMode::shuffled, true)));
    CHECK_FALSE(same_bits(run(CpuMode::serial, true), run(CpuMode::shuffled, false)));
}

TEST_CASE("random lists of small and large dispatches give the same bits on any number of threads")
{
    const auto serial = open(CpuMode::serial);
    const auto two = open(CpuMode::parallel, 2), seven = open(CpuMode::parallel, 7);
    for (unsigned seed = 100; seed < 106; ++seed)
    {
        const std::vector<float> expected = run_random_list(*serial, seed);
        CHECK(same_bits(run_random_list(*two, seed), expected));
        CHECK(same_bits(run_random_list(*seven, seed), expected));
    }
}

TEST_CASE("every element runs exactly once")
{
    const CpuMode mode = GENERATE(CpuMode::serial, CpuMode::parallel, CpuMode::shuffled);
    const KernelInfo* kernel = GENERATE(&local::kTally, &local::kGroupTally);
    const auto device = open(mode);
    for (const std::uint32_t n : {1u, 63u, 64u, 65u, 1000u, 100'003u})
    {
        const BufferPtr counters = device->make_buffer((n + 1) * 4, "counters");
        Recorder recorder(device);
        recorder.dispatch(*kernel, {counters}, CountParams{n}, n);
        recorder.dispatch(*kernel, {counters}, CountParams{n}, n);
        const auto recording = recorder.finish();
        CHECK(recording->barrier_count() == 0); // counters commute
        for (int i = 0; i < 5; ++i)
            recording->replay();
        std::vector<std::uint32_t> expected(n, 10);
        expected.push_back(10 * n);
        CHECK(device->read<std::uint32_t>(counters, n + 1) == expected);
    }
}

TEST_CASE("indirect group counts are read when the dispatch starts")
{
    const CpuMode mode = GENERATE(CpuMode::serial, CpuMode::parallel, CpuMode::shuffled);
    const auto device = open(mode);
    constexpr std::uint32_t kLargest = 1000;
    const BufferPtr counters = device->make_buffer((kLargest + 1) * 4, "counters");
    const BufferPtr groups = device->make_buffer(64, "groups");
    const CountParams params{kLargest};
    const auto total = [&](const KernelInfo& kernel, std::array<std::uint32_t, 3> counts) {
        device->write<std::uint32_t>(counters, std::vector<std::uint32_t>(kLargest + 1, 0));
        Recorder recorder(device);
        recorder.dispatch_indirect(kernel, {counters}, std::as_bytes(std::span(&params, 1)), {groups, 16},
                                   kLargest);
        const auto recording = recorder.finish();
        device->write<std::uint32_t>(groups, counts, 16); // after compiling
        recording->replay();
        return device->read<std::uint32_t>(counters, 1, kLargest * 4)[0];
    };
    CHECK(total(local::kTally, {0, 1, 1}) == 0);
    CHECK(total(local::kTally, {5, 0, 1}) == 0);
    CHECK(total(local::kTally, {1, 1, 1}) == 64);
    CHECK(total(local::kTally, {3, 2, 1}) == 384);
    CHECK(total(local::kTally, {16, 1, 1}) == kLargest); // the last group is cut at the largest count
    CHECK(total(local::kTally, {0xffffffffu, 0xffffffffu, 0xffffffffu}) == kLargest);
    CHECK(total(local::kGroupTally, {0, 0, 0}) == 0);
    CHECK(total(local::kGroupTally, {3, 2, 1}) == 6);
}

TEST_CASE("a dispatch can write the group counts of a later one")
{
    const CpuMode mode = GENERATE(CpuMode::serial, CpuMode::parallel, CpuMode::shuffled);
    const auto device = open(mode);
    const BufferPtr zeros = device->make_buffer(16, "zeros"),
                    groups = upload<std::uint32_t>(*device, {9, 9, 9, 9});
    const BufferPtr counters = device->make_buffer(101 * 4, "counters");
    const CountParams params{100};
    Recorder recorder(device);
    recorder.dispatch(local::kSmooth, {zeros, groups}, CountParams{4}, 4); // 0.0f is also the integer 0
    recorder.dispatch_indirect(local::kTally, {counters}, std::as_bytes(std::span(&params, 1)), groups, 100);
    const auto recording = recorder.finish();
    CHECK(recording->barrier_count() == 1);
    recording->replay();
    CHECK(device->read<std::uint32_t>(counters, 1, 400)[0] == 0);
}

TEST_CASE("the native counters are exact")
{
    const auto device = open(CpuMode::parallel);
    const std::uint64_t kBytes = 4096;
    const BufferPtr a = device->make_buffer(kBytes, "a"), b = device->make_buffer(kBytes, "b");
    CHECK(device->counters().bytes_allocated == 2 * kBytes);
    CHECK(device->counters().memory_blocks == 2);
    CHECK(device->counters().submissions == 0);
    Recorder recorder(device);
    for (int i = 0; i < 10; ++i)
        recorder.dispatch(local::kSmooth, {a, b}, CountParams{1024}, 1024);
    const auto recording = recorder.finish();
    recording->replay();
    recording->replay();
    CHECK(device->counters().submissions == 2);
    CHECK(device->counters().dispatches == 20);
    CHECK(device->counters().barriers == 18);
    CHECK(recording->replay_timed().size() == 10);
    CHECK(device->counters().submissions == 3);
    device->make_buffer(64, "gone at once");
    CHECK(device->counters().bytes_allocated == 2 * kBytes);
    CHECK(device->counters().validation_messages == 0);
}

TEST_CASE("a timed replay does the same work and gives every dispatch its time in order")
{
    const CpuMode mode = GENERATE(CpuMode::serial, CpuMode::parallel);
    const auto device = open(mode);
    const auto run = [&](bool timed) {
        const BufferPtr a = upload(*device, random_floats(5000, 1)), b = device->make_buffer(20'000, "b");
        Recorder recorder(device);
        recorder.dispatch(local::kSmooth, {a, b}, CountParams{5000}, 5000, "there");
        recorder.dispatch(local::kSmooth, {b, a}, CountParams{5000}, 5000, "back");
        const auto recording = recorder.finish();
        if (timed)
        {
            const std::vector<DispatchTime> times = recording->replay_timed();
            REQUIRE(times.size() == 2);
            CHECK(times[0].dispatch == 0);
            CHECK(times[1].dispatch == 1);
            CHECK(times[0].nanoseconds > 0);
            CHECK(recording->dispatches()[1].label == "back");
        }
        else
            recording->replay();
        return device->read<float>(a, 5000);
    };
    CHECK(same_bits(run(true), run(false)));
}

TEST_CASE("recordings and buffers outlive their device")
{
    auto device = open(CpuMode::parallel);
    BufferPtr x = upload(*device, random_floats(50'000, 1));
    const BufferPtr y = device->make_buffer(200'000, "y");
    Recorder recorder(device);
    recorder.dispatch(local::kSmooth, {x, y}, CountParams{50'000}, 50'000);
    auto recording = recorder.finish();
    recorder = Recorder(open(CpuMode::serial)); // lets go of the device
    device.reset();
    x.reset();
    for (int i = 0; i < 10; ++i)
        recording->replay();
    CHECK(recording->dispatches().size() == 1);
}

TEST_CASE("several devices work at once, and one device serves several threads")
{
    const auto expected = run_random_list(*open(CpuMode::serial), 7);
    const auto shared = open(CpuMode::parallel, 2);
    std::atomic<int> right = 0;
    std::vector<std::thread> users;
    for (int i = 0; i < 4; ++i)
        users.emplace_back([&, i] {
            const auto device = i < 2 ? shared : open(CpuMode::parallel, 2);
            right += same_bits(run_random_list(*device, 7), expected);
        });
    for (std::thread& user : users)
        user.join();
    CHECK(right == 4);
}

TEST_CASE("an absurd number of threads is refused") { CHECK_THROWS_AS(open(CpuMode::parallel, 5000), Error); }
