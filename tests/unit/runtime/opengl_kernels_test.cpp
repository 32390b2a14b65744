// Kernels on OpenGL: the bits of native code, the layout check, bad texts, TAUT_KERNEL_DIR.

#include "opengl_support.hpp"

#include "taut/kernels/xpbd_spring.hpp"
#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#include "taut/runtime/base/registry.hpp"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

using namespace taut;
using namespace taut::opengl_test;
using taut::test::refusal;
using taut::test::Refusal;

namespace {

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

    void run_native(const KernelInfo& kernel, const kernels::xpbd_spring::Params& params)
    {
        const std::array<void*, 6> buffers = {constraints.data(), position.data(), delta.data(),
                                              step.data(),        events.data(),   multiplier.data()};
        kernel.native(&params, buffers.data(), 0, params.count);
    }

    Pairs on(const std::shared_ptr<Device>& device, const KernelInfo& kernel,
             const kernels::xpbd_spring::Params& params) const
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
    const KernelInfo& kernel = kernels::xpbd_spring::info(variant, precision);
    for (const std::uint32_t count : {1u, 63u, 64u, 65u, 1000u})
    {
        CAPTURE(variant, count);
        kernels::xpbd_spring::Params params;
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

TEST_CASE("opengl: the driver's words about a bad kernel are in the error, and the device goes on")
{
    TAUT_OPENGL_DEVICE(device);
    const auto good = mark_kernel();
    const std::string text =
        "#version 450\nlayout(local_size_x = 64) in;\nvoid main() { nonsense_here(); }\n";
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
    const Refusal error = refusal([&] { run(bad); });
    CHECK(error.code == ErrorCode::kernel_compilation);
    CHECK(error.says("kernel test"));
    if (!spirv)
        CHECK(error.says("nonsense_here"));
    run(good->info);
    CHECK(device->read<std::uint32_t>(values, 64)[63] == 64);
}

TEST_CASE("opengl: a text in TAUT_KERNEL_DIR replaces the built-in kernel")
{
    TAUT_OPENGL_DEVICE(device);
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::temp_directory_path() / ("taut-opengl-test-" + std::to_string(std::random_device{}()));
    fs::create_directories(folder);
    fs::copy(fs::path(TAUT_SOURCE_DIR) / "kernels/shared", folder / "shared");
    std::ofstream(folder / "test.comp") << "#include \"shared/portable.glsl\"\nPARAMS { uint count; };\n"
                                           "UPDATE(0, uint, values);\nKERNEL(count) { values[i] = 77u; }\n";
    const auto built = mark_kernel();
    const BufferPtr values = device->make_buffer(256, "values");
    const auto last_value = [&] {
        Recorder recorder(device);
        recorder.dispatch(built->info, {values}, CountParams{64}, 64);
        recorder.finish()->replay();
        return device->read<std::uint32_t>(values, 64)[63];
    };
    CHECK(last_value() == 64);
    const char* before = std::getenv("TAUT_KERNEL_DIR");
    const std::string kept = before ? before : "";
    setenv("TAUT_KERNEL_DIR", folder.c_str(), 1);
    CHECK(last_value() == 77);
    setenv("TAUT_KERNEL_DIR", kept.c_str(), 1);
    CHECK(last_value() == 77 + 64);
    fs::remove_all(folder);
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
    CHECK(refusal([&] { recorder.finish(); }).code == ErrorCode::unsupported);
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
        const Refusal error = refusal([&] { recorder.finish(); });
        CHECK(error.code == ErrorCode::kernel_compilation);
        return error;
    };
    CHECK(change("PARAMS { uint count; }", "PARAMS { uint spare; uint count; }")
              .says("parameter count sits at byte 4, expected 0"));
    CHECK(change("UPDATE(0, uint, values)", "UPDATE(1, uint, values)").says("binding 1, expected 0"));
    CHECK(change("UPDATE(0, uint, values);\nKERNEL(count) { values[i] +=",
                 "UPDATE(0, uvec2, values);\nKERNEL(count) { values[i].x +=")
              .says("8 bytes apart, expected 4"));
    CHECK(change("#define TAUT_GROUP_SIZE 64", "#define TAUT_GROUP_SIZE 32").says("groups of 32"));
}
