// The OpenGL executor on whatever driver is here (llvmpipe will do), each test with GLSL text and with
// SPIR-V. Without a driver the tests say so and pass, unless TAUT_REQUIRE_DEVICE=1.
#if __has_include(<EGL/egl.h>)

#include "support/catch.hpp"

#include "taut/kernels/distance.hpp"
#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/compiler/compiler.hpp"
#include "taut/runtime/opengl/commands.hpp"
#include "taut/runtime/opengl/opengl_device.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>

using namespace taut;

namespace {

/// Null, with a visible reason, where `open` finds no device.
template <typename Open>
auto open_or_skip(Open&& open) -> decltype(open())
{
    try
    {
        return open();
    }
    catch (const Error& error)
    {
        const char* required = std::getenv("TAUT_REQUIRE_DEVICE");
        if (required && *required && std::string(required) != "0")
            throw;
        WARN("skipped: " << error.what());
        return nullptr;
    }
}

std::shared_ptr<Device> open_here(bool spirv, bool validation = false)
{
    OpenOptions options;
    options.validation = validation;
    return open_or_skip([&] { return open_opengl(spirv, options); });
}

std::shared_ptr<opengl::Context> context_here(bool validation = false)
{
    return open_or_skip([&] { return opengl::Context::open(validation); });
}

#define TAUT_OPENGL_DEVICE(device)                       \
    const bool spirv = GENERATE(false, true);            \
    CAPTURE(spirv);                                      \
    const std::shared_ptr<Device> device = open_here(spirv); \
    if (!device)                                         \
    return

std::shared_ptr<const CompiledKernel> kernel_of(const std::string& body)
{
    KernelSource source;
    source.name = "test";
    source.text = "#include \"shared/portable.glsl\"\n" + body;
    return compile_kernel(source);
}

struct CountParams
{
    std::uint32_t count;
};

/// values[i] = i + 1 for count elements
std::shared_ptr<const CompiledKernel> mark_kernel()
{
    return kernel_of("PARAMS { uint count; };\nUPDATE(0, uint, values);\n"
                     "KERNEL(count) { values[i] += i + 1u; }\n");
}

std::span<const std::byte> bytes_of(const CountParams& params)
{
    return std::as_bytes(std::span(&params, 1));
}

template <typename T>
BufferPtr buffer_with(Device& device, const std::vector<T>& values, const char* label)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(T), label);
    device.write(buffer, std::span<const T>(values));
    return buffer;
}

bool says(const Error& error, const std::string& part)
{
    UNSCOPED_INFO(error.what());
    return std::string(error.what()).find(part) != std::string::npos;
}

template <typename F>
Error refusal(F&& act)
{
    try
    {
        act();
    }
    catch (const Error& error)
    {
        return error;
    }
    FAIL("nothing was refused");
    throw;
}

/// `count` pairs, as one colour of a cloth has them: none share a vertex.
template <typename real>
struct Pairs
{
    using Vec = std::array<real, 4>;
    std::vector<layout::DistanceConstraint<real>> constraints;
    std::vector<Vec> position, delta;
    std::vector<layout::StepValues<real>> step{1};
    std::vector<std::uint32_t> events = std::vector<std::uint32_t>(TAUT_EVENT_COUNT);
    std::vector<real> multiplier;

    explicit Pairs(std::uint32_t count) : multiplier(count)
    {
        std::mt19937 random(count);
        const auto draw = [&] { return real(random()) / real(4294967296.0) - real(0.5); };
        for (std::uint32_t i = 0; i < count; ++i)
        {
            constraints.push_back({2 * i, 2 * i + 1, real(0.5) + draw() / 4, i % 3 ? real(1e-6) : real(0)});
            for (int end = 0; end < 2; ++end)
            {
                position.push_back({draw(), draw(), draw(), i % 5 ? real(1) + draw() : real(0)});
                delta.push_back({draw() / 64, draw() / 64, draw() / 64, real(0)});
            }
            multiplier[i] = draw();
            if (i % 7 == 3) // coincident ends: skipped and counted
            {
                position[2 * i + 1] = position[2 * i];
                delta[2 * i + 1] = delta[2 * i];
            }
        }
        step[0].substep = real(1) / 600;
        step[0].inverse_substep = real(600);
    }

    void run_native(const KernelInfo& kernel, const kernels::distance::Params& params)
    {
        const std::array<void*, 6> buffers = {constraints.data(), position.data(), delta.data(),
                                              step.data(),        events.data(),   multiplier.data()};
        kernel.native(&params, buffers.data(), 0, params.count);
    }

    Pairs on(const std::shared_ptr<Device>& device, const KernelInfo& kernel,
             const kernels::distance::Params& params) const
    {
        Pairs out = *this;
        const BufferPtr moved = buffer_with(*device, delta, "delta");
        const BufferPtr counted = buffer_with(*device, events, "events");
        const BufferPtr lambda = buffer_with(*device, multiplier, "multiplier");
        std::vector<Recorder::Binding> bindings = {buffer_with(*device, constraints, "constraint"),
                                                   buffer_with(*device, position, "position"),
                                                   moved,
                                                   buffer_with(*device, step, "step_values"),
                                                   counted,
                                                   lambda};
        bindings.resize(kernel.bindings.size(), lambda);
        Recorder recorder(device);
        recorder.dispatch(kernel, bindings, params, params.count);
        recorder.finish()->replay();
        out.delta = device->read<Vec>(moved, delta.size());
        out.events = device->read<std::uint32_t>(counted, events.size());
        out.multiplier = device->read<real>(lambda, multiplier.size());
        return out;
    }
};

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

template <typename real>
void compare_distance(const std::shared_ptr<Device>& device, const char* variant, Precision precision)
{
    const KernelInfo& kernel = kernels::distance::info(variant, precision);
    for (const std::uint32_t count : {1u, 63u, 64u, 65u, 1000u})
    {
        CAPTURE(variant, count);
        kernels::distance::Params params;
        params.count = count;
        params.report = 1;
        Pairs<real> host(count);
        const Pairs<real> found = host.on(device, kernel, params);
        host.run_native(kernel, params);
        CHECK(same_bits(found.delta, host.delta));
        CHECK(same_bits(found.multiplier, host.multiplier));
        CHECK(found.events == host.events);
        if (count > 3)
            CHECK(host.events[TAUT_EVENT_DEGENERATE] > 0);
    }
}

} // namespace

TEST_CASE("opengl: the list names what open_opengl opens")
{
    TAUT_OPENGL_DEVICE(device);
    const std::vector<DeviceInfo> list = list_opengl();
    REQUIRE(list.size() == 2);
    const DeviceInfo& listed = list[spirv ? 1 : 0];
    CHECK(listed.selector == (spirv ? "opengl:spirv" : "opengl"));
    CHECK(device->info().executor == listed.executor);
    CHECK(device->info().name == listed.name);
    CHECK(device->info().driver.find("OpenGL 4.") != std::string::npos);
    CHECK(device->limits().max_bindings >= 8);
    CHECK(device->limits().max_groups_per_dimension >= 65535);
    CHECK(device->limits().max_shared_bytes >= 32768);
    CHECK(device->limits().max_group_size >= 1024);
    if (device->info().name.find("llvmpipe") != std::string::npos)
        CHECK_FALSE(device->info().hardware_gpu);
}

TEST_CASE("opengl: a missing libEGL is a refusal with its name, not a crash")
{
    const Error error = refusal([] { opengl::load_egl("libEGL-that-is-not-there.so.1"); });
    CHECK(error.code() == ErrorCode::no_device);
    CHECK(says(error, "libEGL-that-is-not-there.so.1"));
}

TEST_CASE("opengl: buffers are zero at first and give back what was written")
{
    TAUT_OPENGL_DEVICE(device);
    const BufferPtr buffer = device->make_buffer(1003, "odd size");
    CHECK(device->read<std::uint8_t>(buffer, 1003) == std::vector<std::uint8_t>(1003, 0));
    const std::vector<std::uint8_t> text = {1, 2, 3, 250, 5};
    device->write(buffer, std::span<const std::uint8_t>(text), 998);
    CHECK(device->read<std::uint8_t>(buffer, 5, 998) == text);
    CHECK(device->read<std::uint8_t>(buffer, 1, 997).front() == 0);
}

TEST_CASE("opengl: memory that is freed is no longer counted")
{
    TAUT_OPENGL_DEVICE(device);
    BufferPtr a = device->make_buffer(1000, "a");
    const BufferPtr b = device->make_buffer(24, "b");
    CHECK(device->counters().bytes_allocated == 1024);
    CHECK(device->counters().memory_blocks == 2);
    a.reset();
    CHECK(device->counters().bytes_allocated == 24);
    CHECK(device->counters().memory_blocks == 1);
}

TEST_CASE("opengl: ranges outside a buffer and buffers of another device are refused")
{
    TAUT_OPENGL_DEVICE(device);
    const BufferPtr buffer = device->make_buffer(16, "small");
    std::vector<std::byte> data(9);
    CHECK(refusal([&] { device->write(buffer, 8, data); }).code() == ErrorCode::bad_input);
    CHECK(refusal([&] { device->read(buffer, 17, std::span(data).first(0)); }).code() == ErrorCode::bad_input);
    CHECK(refusal([&] { device->read(nullptr, 0, data); }).code() == ErrorCode::bad_input);
    const auto other = open_here(spirv);
    CHECK(refusal([&] { other->read(buffer, 0, data); }).code() == ErrorCode::bad_input);
    CHECK(refusal([&] { device->make_buffer(0, "empty"); }).code() == ErrorCode::bad_input);
}

TEST_CASE("opengl: a buffer beyond the limit is refused with both numbers")
{
    TAUT_OPENGL_DEVICE(device);
    const std::uint64_t most = device->limits().max_buffer_bytes;
    const Error error = refusal([&] { device->make_buffer(most + 1, "huge"); });
    CHECK(error.code() == ErrorCode::limit);
    CHECK(says(error, "huge"));
    CHECK(says(error, std::to_string(most)));
    CHECK(says(error, std::to_string(most + 1)));
}

TEST_CASE("opengl: a binding at an offset that the driver cannot bind is refused")
{
    TAUT_OPENGL_DEVICE(device);
    const auto kernel = mark_kernel();
    const BufferPtr buffer = device->make_buffer(4096, "values");
    const auto record = [&](std::uint64_t offset) { // not by Recorder, which has its own checks
        const CountParams params{64};
        Dispatch dispatch{&kernel->info, {{0, offset, 256}}, {}, 64, {kNoBuffer, 0, 0}, ""};
        dispatch.params.assign(bytes_of(params).begin(), bytes_of(params).end());
        device->compile({{buffer}, {dispatch}, {false}})->replay();
    };
    CHECK(refusal([&] { record(4); }).code() == ErrorCode::limit);
    record(device->limits().offset_alignment);
    const auto first = static_cast<std::size_t>(device->limits().offset_alignment / 4);
    const auto values = device->read<std::uint32_t>(buffer, 1024);
    CHECK(values[first - 1] == 0);
    CHECK(values[first] == 1);
    CHECK(values[first + 63] == 64);
    CHECK(values[first + 64] == 0);
}

TEST_CASE("opengl: the distance kernel gives the bits of its native form")
{
    TAUT_OPENGL_DEVICE(device);
    compare_distance<float>(device, "", Precision::float32);
    compare_distance<float>(device, "lambda", Precision::float32);
}

TEST_CASE("opengl: the distance kernel in double gives the bits of its native form")
{
    TAUT_OPENGL_DEVICE(device);
    REQUIRE(device->limits().float64);
    compare_distance<double>(device, "", Precision::float64);
    compare_distance<double>(device, "lambda", Precision::float64);
}

TEST_CASE("opengl: every built-in kernel compiles and passes the layout check")
{
    TAUT_OPENGL_DEVICE(device);
    const BufferPtr room = device->make_buffer(1 << 16, "room");
    for (const KernelInfo* kernel : all_kernels())
    {
        CAPTURE(std::string(kernel->name), std::string(kernel->variant), to_string(kernel->precision));
        RecordingDesc desc;
        Dispatch dispatch;
        dispatch.kernel = kernel;
        dispatch.params.resize(kernel->param_bytes);
        for (std::size_t i = 0; i < kernel->bindings.size(); ++i)
        {
            desc.buffers.push_back(device->make_buffer(1 << 12, "room"));
            dispatch.bindings.push_back({static_cast<std::uint32_t>(i), 0, 1 << 12});
        }
        desc.dispatches = {dispatch};
        desc.barrier_before = {false};
        CHECK_NOTHROW(device->compile(std::move(desc))->replay());
        device->wait();
    }
}

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
    // A million times the work: only a clock that does not tick could disagree.
    CHECK(times[1].nanoseconds > times[0].nanoseconds);
    CHECK(times[1].nanoseconds > times[2].nanoseconds);
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
    for (const opengl::Command& c : opengl::make_commands({buffers, list, barriers, programs, params, 65535}, {}))
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

TEST_CASE("opengl: the driver's words about a bad kernel are in the error, and the device goes on")
{
    TAUT_OPENGL_DEVICE(device);
    const auto good = mark_kernel();
    const std::string text = "#version 450\nlayout(local_size_x = 64) in;\nvoid main() { nonsense_here(); }\n";
    const std::array<std::uint32_t, 3> words = {1, 2, 3};
    KernelInfo bad = good->info;
    bad.glsl = text;
    bad.spirv_opengl = words;
    const BufferPtr values = device->make_buffer(256, "values");
    const auto run = [&](const KernelInfo& kernel) {
        Recorder recorder(device);
        recorder.dispatch(kernel, {values}, CountParams{64}, 64);
        recorder.finish()->replay();
    };
    const Error error = refusal([&] { run(bad); });
    CHECK(error.code() == ErrorCode::kernel_compilation);
    CHECK(says(error, "kernel test"));
    if (!spirv)
        CHECK(says(error, "nonsense_here"));
    run(good->info);
    CHECK(device->read<std::uint32_t>(values, 64)[63] == 64);
}

TEST_CASE("opengl: a kernel without the form that the device takes is refused")
{
    TAUT_OPENGL_DEVICE(device);
    const auto good = mark_kernel();
    KernelInfo bare = good->info;
    bare.glsl = {};
    bare.spirv_opengl = {};
    Recorder recorder(device);
    recorder.dispatch(bare, {device->make_buffer(256, "values")}, CountParams{64}, 64);
    CHECK(refusal([&] { recorder.finish(); }).code() == ErrorCode::unsupported);
}

TEST_CASE("opengl: memory that the driver cannot give is a refusal, and the context goes on")
{
    const auto context = context_here();
    if (!context)
        return;
    const opengl::Context::Use use(*context);
    const Error error = refusal([&] { opengl::GlBuffer(context, std::uint64_t{1} << 60, "endless"); });
    CHECK(error.code() == ErrorCode::out_of_memory);
    CHECK(says(error, "endless"));
    CHECK(context->counters().memory_blocks == 0);
    CHECK_NOTHROW(opengl::GlBuffer(context, 64, "modest"));
}

TEST_CASE("opengl: a text whose layout is not the table's is refused")
{
    const auto device = open_here(false);
    if (!device)
        return;
    const auto good = mark_kernel();
    const BufferPtr values = device->make_buffer(256, "values");
    const auto change = [&](const std::string& from, const std::string& to) {
        std::string text(good->info.glsl);
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        REQUIRE(text != good->info.glsl);
        KernelInfo bad = good->info;
        bad.glsl = text;
        Recorder recorder(device);
        recorder.dispatch(bad, {values}, CountParams{64}, 64);
        const Error error = refusal([&] { recorder.finish(); });
        CHECK(error.code() == ErrorCode::kernel_compilation);
        return error;
    };
    CHECK(says(change("PARAMS { uint count; }", "PARAMS { uint spare; uint count; }"), "parameter count sits at byte 4, expected 0"));
    CHECK(says(change("UPDATE(0, uint, values)", "UPDATE(1, uint, values)"), "binding 1, expected 0"));
    CHECK(says(change("UPDATE(0, uint, values);\nKERNEL(count) { values[i] +=",
                      "UPDATE(0, uvec2, values);\nKERNEL(count) { values[i].x +="), "8 bytes apart, expected 4"));
    CHECK(says(change("#define TAUT_GROUP_SIZE 64", "#define TAUT_GROUP_SIZE 32"), "groups of 32"));
}

TEST_CASE("opengl: a context of the host stays current and keeps its objects")
{
    TAUT_OPENGL_DEVICE(device);
    const auto host = context_here();
    GLuint theirs = 0, bound = 0;
    {
        const opengl::Context::Use use(*host);
        host->gl().CreateBuffers(1, &theirs);
        host->gl().BindBuffer(GL_SHADER_STORAGE_BUFFER, theirs);
        const auto kernel = mark_kernel();
        const auto another = open_here(spirv);
        CHECK(host->is_current());
        const BufferPtr values = another->make_buffer(256, "values");
        CHECK(host->is_current());
        Recorder recorder(another);
        recorder.dispatch(kernel->info, {values}, CountParams{64}, 64);
        const auto recording = recorder.finish();
        CHECK(host->is_current());
        recording->replay();
        CHECK(host->is_current());
        recording->replay_timed();
        CHECK(host->is_current());
        CHECK(another->read<std::uint32_t>(values, 64)[63] == 128);
        CHECK(host->is_current());
        CHECK_THROWS_AS(another->read<std::uint32_t>(values, 65), Error);
        CHECK(host->is_current());
        list_opengl();
        CHECK(host->is_current());
        CHECK(host->gl().IsBuffer(theirs));
        host->gl().GetIntegerv(GL_SHADER_STORAGE_BUFFER_BINDING, reinterpret_cast<GLint*>(&bound));
        CHECK(bound == theirs);
        host->gl().DeleteBuffers(1, &theirs);
    }
    CHECK_FALSE(host->is_current());
}

TEST_CASE("opengl: an OpenGL ES context of the host and its choice of API come back")
{
    TAUT_OPENGL_DEVICE(device);
    const opengl::Egl& egl = opengl::egl_library();
    const EGLDisplay display = opengl::windowless_displays(egl).front().display;
    REQUIRE(egl.BindAPI(EGL_OPENGL_ES_API));
    const EGLint es3[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLContext theirs = egl.CreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, es3);
    if (theirs == EGL_NO_CONTEXT)
    {
        WARN("skipped: no OpenGL ES here");
        return;
    }
    REQUIRE(egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, theirs));
    const BufferPtr values = device->make_buffer(256, "values");
    CHECK(device->read<std::uint32_t>(values, 64)[63] == 0);
    CHECK(egl.QueryAPI() == EGL_OPENGL_ES_API);
    CHECK(egl.GetCurrentContext() == theirs);
    egl.MakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    egl.DestroyContext(display, theirs);
    CHECK(device->read<std::uint32_t>(values, 64)[63] == 0);
    CHECK(egl.GetCurrentContext() == EGL_NO_CONTEXT);
}

TEST_CASE("opengl: several threads may use one device")
{
    TAUT_OPENGL_DEVICE(device);
    const auto kernel = mark_kernel();
    std::array<std::uint32_t, 3> last{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < last.size(); ++t)
        threads.emplace_back([&, t] {
            const BufferPtr values = device->make_buffer(256, "values");
            Recorder recorder(device);
            recorder.dispatch(kernel->info, {values}, CountParams{64}, 64);
            const auto recording = recorder.finish();
            for (std::size_t i = 0; i < 20 + t; ++i)
                recording->replay();
            last[t] = device->read<std::uint32_t>(values, 64)[63];
        });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(last == std::array<std::uint32_t, 3>{20 * 64, 21 * 64, 22 * 64});
}

TEST_CASE("opengl: buffers and recordings may outlive their device")
{
    TAUT_OPENGL_DEVICE(device);
    const auto kernel = mark_kernel();
    std::unique_ptr<Recording> recording;
    BufferPtr values;
    {
        const auto gone = open_here(spirv);
        values = gone->make_buffer(256, "values");
        Recorder recorder(gone);
        recorder.dispatch(kernel->info, {values}, CountParams{64}, 64);
        recording = recorder.finish();
    }
    CHECK_NOTHROW(recording->replay());
}

TEST_CASE("opengl: ordinary work gives the debug context nothing to say")
{
    const bool spirv = GENERATE(false, true);
    CAPTURE(spirv);
    const auto device = open_here(spirv, true);
    if (!device)
        return;
    Pairs<float> host(100);
    kernels::distance::Params params;
    params.count = 100;
    host.on(device, kernels::distance::info(), params);
    CHECK(device->counters().validation_messages == 0);
}

TEST_CASE("opengl: the debug context counts a mistake, and the device is lost after it")
{
    const auto context = context_here(true);
    if (!context)
        return;
    const opengl::Context::Use use(*context);
    context->gl().DispatchComputeIndirect(1); // not a multiple of four
    CHECK(context->counters().validation_messages >= 1);
    CHECK(refusal([&] { context->check("making a mistake"); }).code() == ErrorCode::device_lost);
    CHECK(refusal([&] { const opengl::Context::Use again(*context); }).code() == ErrorCode::device_lost);
}

#endif
