// The OpenGL executor as a device: buffers, limits, contexts, threads, errors of the driver.

#include "support/skip.hpp"
#include "opengl_support.hpp"

#include "taut/runtime/opengl/buffer.hpp"

#include <array>
#include <thread>

using namespace taut;
using namespace taut::opengl_test;
using taut::test::refusal;
using taut::test::Refusal;

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
    const Refusal error = refusal([] { opengl::load_egl("libEGL-that-is-not-there.so.1"); });
    CHECK(error.code == ErrorCode::no_device);
    CHECK(error.says("libEGL-that-is-not-there.so.1"));
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
    CHECK(refusal([&] { device->write(buffer, 8, data); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->read(buffer, 17, std::span(data).first(0)); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->read(nullptr, 0, data); }).code == ErrorCode::bad_input);
    const auto other = open_here(spirv);
    CHECK(refusal([&] { other->read(buffer, 0, data); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->make_buffer(0, "empty"); }).code == ErrorCode::bad_input);
}

TEST_CASE("opengl: a buffer beyond the limit is refused with both numbers")
{
    TAUT_OPENGL_DEVICE(device);
    const std::uint64_t most = device->limits().max_buffer_bytes;
    const Refusal error = refusal([&] { device->make_buffer(most + 1, "huge"); });
    CHECK(error.code == ErrorCode::limit);
    CHECK(error.says("huge"));
    CHECK(error.says(std::to_string(most)));
    CHECK(error.says(std::to_string(most + 1)));
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
    CHECK(refusal([&] { record(4); }).code == ErrorCode::limit);
    record(device->limits().offset_alignment);
    const auto first = static_cast<std::size_t>(device->limits().offset_alignment / 4);
    const auto values = device->read<std::uint32_t>(buffer, 1024);
    CHECK(values[first - 1] == 0);
    CHECK(values[first] == 1);
    CHECK(values[first + 63] == 64);
    CHECK(values[first + 64] == 0);
}

TEST_CASE("opengl: memory that the driver cannot give is a refusal, and the context goes on")
{
    const auto context = context_here();
    if (!context)
        return;
    const opengl::Context::Use use(*context);
    const Refusal error = refusal([&] { opengl::GlBuffer(context, std::uint64_t{1} << 60, "endless"); });
    CHECK(error.code == ErrorCode::out_of_memory);
    CHECK(error.says("endless"));
    CHECK(context->counters().memory_blocks == 0);
    CHECK_NOTHROW(opengl::GlBuffer(context, 64, "modest"));
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
        TAUT_LEFT_OUT("no OpenGL ES here");
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
    const auto mark = mark_kernel();
    const std::vector<std::uint32_t> start(64, 1);
    const BufferPtr values = buffer_with(*device, start, "values");
    const BufferPtr groups = buffer_with(*device, std::vector<std::uint32_t>{1, 1, 1}, "groups");
    const CountParams params{64};
    Recorder recorder(device);
    recorder.dispatch(mark->info, {values}, params, 64);
    recorder.dispatch_indirect(mark->info, {values}, bytes_of(params), {groups, 0, 12}, 64);
    const auto recording = recorder.finish();
    recording->replay();
    recording->replay_timed();
    CHECK(device->read<std::uint32_t>(values, 64)[63] == 1 + 4 * 64);
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
    CHECK(refusal([&] { context->check("making a mistake"); }).code == ErrorCode::device_lost);
    CHECK(refusal([&] { const opengl::Context::Use again(*context); }).code == ErrorCode::device_lost);
}
