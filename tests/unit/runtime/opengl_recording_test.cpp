// Recordings on OpenGL: counters, times, barriers, indirect and folded dispatches.

#include "opengl_support.hpp"

#include "taut/runtime/opengl/commands.hpp"

#include <algorithm>

using namespace taut;
using namespace taut::opengl_test;
using taut::test::refusal;
using taut::test::Refusal;

TEST_CASE("opengl: one replay is one submission, and barriers are the recording's own")
{
    TAUT_OPENGL_DEVICE(device);
    const auto kernel = mark_kernel();
    const BufferPtr a = device->make_buffer(400, "a"), b = device->make_buffer(400, "b");
    Recorder recorder(device);
    for (int i = 0; i < 10; ++i)
    {
        recorder.dispatch(kernel->info, {a}, CountParams{100}, 100);
        recorder.dispatch(kernel->info, {b}, CountParams{100}, 100);
    }
    const auto recording = recorder.finish();
    CHECK(recording->barrier_count() == 9); // a and b do not meet
    const DeviceCounters before = device->counters();
    for (int i = 0; i < 3; ++i)
        recording->replay();
    device->wait();
    const DeviceCounters after = device->counters();
    CHECK(after.submissions - before.submissions == 3);
    CHECK(after.dispatches - before.dispatches == 60);
    CHECK(after.barriers - before.barriers == 3 * recording->barrier_count());
    const auto values = device->read<std::uint32_t>(b, 100);
    CHECK(values[0] == 30);
    CHECK(values[99] == 3000);
}

TEST_CASE("opengl: a timed replay does the same work and gives a time for each dispatch")
{
    TAUT_OPENGL_DEVICE(device);
    const auto heavy = kernel_of("PARAMS { uint count; };\nUPDATE(0, uint, values);\n"
                                 "KERNEL(count) { uint x = values[i] + i; for (uint k = 0u; k < 4000u; ++k)"
                                 " x = x * 1664525u + 1013904223u; values[i] = x; }\n");
    const auto light = mark_kernel();
    const BufferPtr buffer = device->make_buffer(4 * 16384, "values");
    Recorder recorder(device);
    recorder.dispatch(light->info, {buffer}, CountParams{64}, 64);
    recorder.dispatch(heavy->info, {buffer}, CountParams{16384}, 16384);
    recorder.dispatch(light->info, {buffer}, CountParams{64}, 64);
    const auto recording = recorder.finish();
    recording->replay();
    const auto once = device->read<std::uint32_t>(buffer, 16384);
    device->write(buffer, std::span<const std::uint32_t>(std::vector<std::uint32_t>(16384)));

    const DeviceCounters before = device->counters();
    const std::vector<DispatchTime> times = recording->replay_timed();
    CHECK(device->counters().submissions - before.submissions == 1);
    CHECK(device->read<std::uint32_t>(buffer, 16384) == once);
    REQUIRE(times.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
    {
        CHECK(times[i].dispatch == i);
        CHECK(times[i].nanoseconds >= 0);
    }
    // 4,000 steps, each of which needs the one before: no device does one in a tenth of a nanosecond.
    CHECK(times[1].nanoseconds > 400);
}

TEST_CASE("opengl: consecutive replays see each other's results")
{
    TAUT_OPENGL_DEVICE(device);
    const auto twice = kernel_of("PARAMS { uint count; };\nREAD(0, uint, from);\nWRITE(1, uint, to);\n"
                                 "KERNEL(count) { to[i] = from[i] * 3u + 1u; }\n");
    const BufferPtr a = device->make_buffer(4000, "a"), b = device->make_buffer(4000, "b");
    Recorder there(device), back(device);
    there.dispatch(twice->info, {a, b}, CountParams{1000}, 1000);
    back.dispatch(twice->info, {b, a}, CountParams{1000}, 1000);
    const auto first = there.finish(), second = back.finish();
    std::uint32_t expected = 0;
    for (int i = 0; i < 8; ++i)
    {
        first->replay();
        second->replay();
        expected = (expected * 3 + 1) * 3 + 1;
    }
    CHECK(device->read<std::uint32_t>(a, 1000) == std::vector<std::uint32_t>(1000, expected));
}

TEST_CASE("opengl: group counts written on the device start that many groups, and zero starts none")
{
    TAUT_OPENGL_DEVICE(device);
    const auto decide = kernel_of("PARAMS { uint count; };\nREAD(0, uint, wish);\nWRITE(1, uint, groups);\n"
                                  "KERNEL(count) { groups[i] = i % 3u == 0u ? wish[0] : 1u; }\n");
    const auto mark = mark_kernel();
    const CountParams all{1000};
    const BufferPtr wish = device->make_buffer(4, "wish"), groups = device->make_buffer(24, "groups");
    const BufferPtr values = device->make_buffer(4000, "values");
    Recorder recorder(device);
    recorder.dispatch(decide->info, {wish, groups}, CountParams{6}, 6);
    recorder.dispatch_indirect(mark->info, {values}, bytes_of(all), {groups, 12, 12}, 1000);
    const auto recording = recorder.finish();
    CHECK(recording->barrier_count() == 1);
    std::uint32_t marked = 0;
    for (const std::uint32_t wanted : {0u, 2u, 0u, 16u})
    {
        device->write(wish, std::span<const std::uint32_t>(&wanted, 1));
        recording->replay();
        const auto seen = device->read<std::uint32_t>(values, 1000);
        marked += wanted > 0 ? 1 : 0;
        CHECK(seen[0] == marked);
        CHECK(seen[127] == 128 * marked);
        CHECK(seen[128] == (wanted == 16 ? 129u : 0u));
        CHECK(seen[999] == (wanted == 16 ? 1000u : 0u));
    }
}

TEST_CASE("opengl: a barrier carries the indirect bit only where group counts were written")
{
    TAUT_OPENGL_DEVICE(device);
    const auto mark = mark_kernel();
    const BufferPtr groups = device->make_buffer(256, "groups"), values = device->make_buffer(256, "values");
    const std::vector<BufferPtr> buffers = {groups, values};
    const auto to = [&](std::uint32_t buffer, BufferRange indirect = {kNoBuffer, 0, 0}) {
        return Dispatch{&mark->info, {{buffer, 0, 256}}, std::vector<std::byte>(4), 64, indirect, ""};
    };
    const std::vector<Dispatch> list = {to(1), to(1), to(0), to(1, {0, 0, 12}), to(1), to(1, {0, 0, 12})};
    const std::vector<bool> barriers = derive_barriers(list);
    REQUIRE(barriers == std::vector<bool>{false, true, false, true, true, true});

    const auto context = context_here();
    const opengl::Context::Use use(*context);
    const opengl::ParamBlocks params(context, list);
    const std::vector<std::shared_ptr<opengl::Program>> programs(
        list.size(), std::make_shared<opengl::Program>(context, mark->info, spirv));
    std::vector<GLuint> bits;
    for (const opengl::Command& c :
         opengl::make_commands({buffers, list, barriers, programs, params, 65535}, {}))
        if (c.op == opengl::Command::Op::barrier)
            bits.push_back(c.object);
    constexpr GLuint kStorage = GL_SHADER_STORAGE_BARRIER_BIT, kBoth = kStorage | GL_COMMAND_BARRIER_BIT;
    CHECK(bits == std::vector<GLuint>{kBoth, kStorage, kBoth, kStorage, kBoth, GL_BUFFER_UPDATE_BARRIER_BIT});
}

TEST_CASE("opengl: nothing is bound twice in a row")
{
    TAUT_OPENGL_DEVICE(device);
    const auto mark = mark_kernel();
    const std::vector<BufferPtr> buffers = {device->make_buffer(256, "values")};
    const std::vector<Dispatch> list(
        100, Dispatch{&mark->info, {{0, 0, 256}}, std::vector<std::byte>(4), 64, {kNoBuffer, 0, 0}, ""});
    const auto context = context_here();
    const opengl::Context::Use use(*context);
    const opengl::ParamBlocks params(context, list);
    const std::vector<std::shared_ptr<opengl::Program>> programs(
        list.size(), std::make_shared<opengl::Program>(context, mark->info, spirv));
    const auto commands =
        opengl::make_commands({buffers, list, derive_barriers(list), programs, params, 65535}, {});
    CHECK(commands.size() == 3 + 100 + 99 + 2); // binds, dispatches, barriers between, first and last barrier
}

TEST_CASE("opengl: more than 65,535 groups are folded and every element runs once")
{
    TAUT_OPENGL_DEVICE(device);
    const auto mark = mark_kernel();
    const std::uint32_t count = 65536 * kGroupSize + 7;
    const BufferPtr values = device->make_buffer(std::uint64_t{4} * (count + 64), "values");
    Recorder recorder(device);
    recorder.dispatch(mark->info, {values}, CountParams{count}, count);
    recorder.finish()->replay();
    const auto seen = device->read<std::uint32_t>(values, count + 64);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < seen.size(); ++i)
        wrong += seen[i] != (i < count ? i + 1 : 0) ? 1 : 0;
    CHECK(wrong == 0);
}

TEST_CASE("opengl: a group kernel shares memory between phases")
{
    TAUT_OPENGL_DEVICE(device);
    const auto sum = kernel_of("PARAMS { uint count; };\nREAD(0, uint, values);\nWRITE(1, uint, sums);\n"
                               "SHARED(uint, part, 32);\n"
                               "GROUP_KERNEL(32)\n{\n"
                               "PHASE_BEGIN part[lane] = values[group * 32u + lane]; PHASE_END\n"
                               "PHASE_BEGIN if (lane == 0u) { uint s = 0u; for (uint k = 0u; k < 32u; ++k)"
                               " s += part[k]; sums[group] = s; } PHASE_END\n}\n");
    std::vector<std::uint32_t> values(96);
    for (std::uint32_t i = 0; i < 96; ++i)
        values[i] = i * i;
    const BufferPtr in = buffer_with(*device, values, "values"), out = device->make_buffer(12, "sums");
    Recorder recorder(device);
    recorder.dispatch(sum->info, {in, out}, CountParams{3}, 3);
    recorder.finish()->replay();
    std::vector<std::uint32_t> expected(3);
    for (std::uint32_t i = 0; i < 96; ++i)
        expected[i / 32] += values[i];
    CHECK(device->read<std::uint32_t>(out, 3) == expected);
}

TEST_CASE("opengl: each dispatch sees its own parameters")
{
    TAUT_OPENGL_DEVICE(device);
    const auto put = kernel_of("PARAMS { uint count; uint first; float value; int sign; uint more; };\n"
                               "WRITE(0, float, values);\n"
                               "KERNEL(count) { values[first + i] = value * float(sign) + float(more); }\n");
    struct Params
    {
        std::uint32_t count, first;
        float value;
        std::int32_t sign;
        std::uint32_t more;
    };
    const BufferPtr values = device->make_buffer(400, "values");
    Recorder recorder(device);
    std::vector<float> expected;
    for (std::uint32_t i = 0; i < 100; ++i)
    {
        const Params p{1, i, 0.25f * float(i % 10), i % 2 ? 1 : -1, i / 50};
        recorder.dispatch(put->info, {values}, p, 1);
        expected.push_back(p.value * float(p.sign) + float(p.more));
    }
    recorder.finish()->replay();
    CHECK(device->read<float>(values, 100) == expected);
}
