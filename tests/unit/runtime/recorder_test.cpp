#include "local_kernels.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"
#include "taut/runtime/device.hpp"
#include "taut/runtime/limits.hpp"

#include <array>
#include <functional>
#include <utility>

using namespace taut;
using local::CountParams;
using test::refusal;
using test::Refusal;

namespace {

struct Fixture
{
    std::shared_ptr<Device> device = Device::open("cpu:serial");
    BufferPtr a = device->make_buffer(1024, "a");
    BufferPtr b = device->make_buffer(1024, "b");
    Recorder recorder{device};

    Refusal smooth(std::vector<Recorder::Binding> bindings)
    {
        return refusal([&] { recorder.dispatch(local::kSmooth, std::move(bindings), CountParams{16}, 16); });
    }
};

} // namespace

// ---------------------------------------------------------------- recorder

TEST_CASE("a dispatch that fits is recorded with its ranges and label")
{
    Fixture f;
    f.recorder.dispatch(local::kSmooth, {{f.a, 64}, {f.b, 128, 256}}, CountParams{16}, 16, "relax");
    f.recorder.dispatch(local::kSmooth, {f.b, f.a}, CountParams{16}, 16);
    CHECK(f.recorder.size() == 2);
    const auto recording = f.recorder.finish();
    CHECK(f.recorder.size() == 0);
    const Dispatch& first = recording->dispatches()[0];
    CHECK(first.bindings[0].offset == 64);
    CHECK(first.bindings[0].bytes == 960);
    CHECK(first.bindings[1].bytes == 256);
    CHECK(first.bindings[0].buffer == recording->dispatches()[1].bindings[1].buffer);
    CHECK(first.label == "relax");
    CHECK(recording->dispatches()[1].label == "smooth");
    CHECK(recording->barrier_before() == std::vector<bool>{false, true});
    CHECK(recording->barrier_count() == 1);
}

TEST_CASE("a count of zero adds nothing, but is checked")
{
    Fixture f;
    f.recorder.dispatch(local::kSmooth, {f.a, f.b}, CountParams{0}, 0);
    CHECK(f.recorder.size() == 0);
    CHECK(refusal([&] { f.recorder.dispatch(local::kSmooth, {f.a}, CountParams{0}, 0); }).code ==
          ErrorCode::bad_input);
    const auto empty = f.recorder.finish();
    empty->replay();
    CHECK(empty->replay_timed().empty());
}

TEST_CASE("the wrong number of buffers is refused with both numbers")
{
    Fixture f;
    const Refusal no = f.smooth({f.a});
    CHECK(no.code == ErrorCode::bad_input);
    CHECK(no.text == "kernel \"smooth\" has 2 bindings, but 1 buffers were given");
}

TEST_CASE("parameters of the wrong size are refused with both numbers")
{
    Fixture f;
    const Refusal no = refusal([&] { f.recorder.dispatch(local::kSmooth, {f.a, f.b}, 16); });
    CHECK(no.code == ErrorCode::bad_input);
    CHECK(no.text == "kernel \"smooth\" takes 4 bytes of parameters, but 0 were given");
}

TEST_CASE("a range outside its buffer is refused with kernel, binding and numbers")
{
    Fixture f;
    const Refusal long_range = f.smooth({f.a, {f.b, 512, 516}});
    CHECK(long_range.code == ErrorCode::bad_input);
    CHECK(long_range.text == "kernel \"smooth\", binding 1 \"result\": bytes 512 to 1028 lie outside the "
                             "buffer, which has 1024 bytes");
    CHECK(f.smooth({{f.a, 1024}, f.b}).says("range is empty"));
    CHECK(f.smooth({{f.a, 2048}, f.b}).says("range is empty"));
    CHECK(f.smooth({{f.a, 16, ~std::uint64_t{0} - 7}, f.b}).says("lie outside the buffer"));
    CHECK(f.smooth({BufferPtr{}, f.b}).says("there is no buffer"));
    CHECK(f.recorder.size() == 0);
}

TEST_CASE("an offset off the alignment of the device is refused with both numbers")
{
    Fixture f;
    const Refusal no = f.smooth({{f.a, 20, 64}, f.b});
    CHECK(no.code == ErrorCode::bad_input);
    CHECK(no.says("binding 0 \"in\": offset 20 is not a multiple of the 16 bytes"));
}

TEST_CASE("a range with part of an element is refused")
{
    Fixture f;
    CHECK(f.smooth({{f.a, 0, 62}, f.b}).says("62 bytes are not a whole number of elements of 4 bytes"));
    KernelInfo wide = local::kTally;
    const std::array bindings = {BindingInfo{"x", 0, Access::read, 2048}};
    wide.bindings = bindings;
    CHECK(
        refusal([&] { f.recorder.dispatch(wide, {f.a}, CountParams{1}, 1); }).says("elements of 2048 bytes"));
}

TEST_CASE("indirect group counts must lie in their buffer on four bytes")
{
    Fixture f;
    const CountParams params{16};
    const auto add = [&](Recorder::Binding counts) {
        return refusal([&] {
            f.recorder.dispatch_indirect(local::kSmooth, {f.a, f.b}, std::as_bytes(std::span(&params, 1)),
                                         counts, 16);
        });
    };
    CHECK(add({f.a, 1016}).says("bytes 1016 to 1028 lie outside"));
    CHECK(add({f.a, 6}).says("offset 6 is not a multiple of the 4 bytes"));
    CHECK(add({nullptr}).says("there is no buffer"));
    CHECK_FALSE(add({f.device->make_buffer(12, "counts")}).code);
    CHECK(f.recorder.size() == 1);
}

// ---------------------------------------------------------------- limits

namespace {

/// One dispatch of `kernel` over one buffer of 4096 bytes, on a device with the limits of `change`.
Refusal compile_with(const std::function<void(KernelInfo&, Dispatch&, DeviceInfo&)>& change)
{
    Fixture f;
    KernelInfo kernel = local::kTally;
    DeviceInfo info = f.device->info();
    info.name = "small device";
    RecordingDesc desc;
    desc.buffers = {f.device->make_buffer(4096, "x")};
    Dispatch dispatch;
    dispatch.kernel = &kernel;
    dispatch.bindings = {{0, 0, 4096}};
    dispatch.params.resize(4);
    dispatch.count = 1000;
    change(kernel, dispatch, info);
    desc.dispatches = {dispatch};
    desc.barrier_before = {false};
    return refusal([&] { check_limits(desc, info); });
}

} // namespace

TEST_CASE("a list within the limits passes")
{
    CHECK_FALSE(compile_with([](KernelInfo&, Dispatch&, DeviceInfo&) {}).code);
    CHECK_FALSE(
        compile_with([](KernelInfo&, Dispatch&, DeviceInfo& i) { i.limits.max_buffer_bytes = 4096; }).code);
}

TEST_CASE("every limit that is exceeded is refused with the kernel and both numbers")
{
    using Change = std::function<void(KernelInfo&, Dispatch&, DeviceInfo&)>;
    const std::pair<Change, std::string> cases[] = {
        {[](KernelInfo&, Dispatch&, DeviceInfo& i) { i.limits.max_buffer_bytes = 4095; },
         "kernel \"tally\", binding 0 \"counters\" needs 4096 bytes in one binding, but this device has a "
         "limit of 4095"},
        {[](KernelInfo&, Dispatch& d, DeviceInfo& i) {
             d.bindings[0] = {0, 48, 64};
             i.limits.offset_alignment = 64;
         },
         "offset 48 is not a multiple of the 64 bytes"},
        {[](KernelInfo& k, Dispatch&, DeviceInfo& i) {
             k.shared_bytes = 40'000;
             i.limits.max_shared_bytes = 32'768;
         },
         "needs 40000 bytes of group memory, but this device has a limit of 32768"},
        {[](KernelInfo& k, Dispatch&, DeviceInfo& i) {
             k.group_size = 256;
             i.limits.max_group_size = 128;
         },
         "needs 256 invocations a group, but this device has a limit of 128"},
        {[](KernelInfo&, Dispatch&, DeviceInfo& i) { i.limits.max_param_bytes = 3; },
         "needs 4 bytes of parameters, but this device has a limit of 3"},
        {[](KernelInfo&, Dispatch&, DeviceInfo& i) { i.limits.max_bindings = 0; },
         "needs 1 storage buffers, but this device has a limit of 0"},
        {[](KernelInfo&, Dispatch&, DeviceInfo& i) { i.limits.max_groups_per_dimension = 3; },
         "needs 16 groups, but this device has a limit of 9"},
    };
    for (const auto& [change, words] : cases)
    {
        const Refusal no = compile_with(change);
        CAPTURE(no.text, words);
        CHECK(no.code == ErrorCode::limit);
        CHECK(no.says("kernel \"tally\""));
        CHECK(no.says(words));
    }
}

TEST_CASE("a double kernel on a device without 64-bit floats is unsupported")
{
    const Refusal no = compile_with([](KernelInfo& k, Dispatch&, DeviceInfo& i) {
        k.precision = Precision::float64;
        i.limits.float64 = false;
    });
    CHECK(no.code == ErrorCode::unsupported);
    CHECK(no.says("small device"));
}

TEST_CASE("a list that contradicts itself is refused")
{
    const auto code = [](const Refusal& no) { return no.code; };
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) { d.bindings[0].buffer = 5; })) ==
          ErrorCode::bad_input);
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) { d.bindings[0].bytes = 4100; })) ==
          ErrorCode::bad_input);
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) { d.bindings.clear(); })) ==
          ErrorCode::bad_input);
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) { d.params.clear(); })) ==
          ErrorCode::bad_input);
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) { d.kernel = nullptr; })) ==
          ErrorCode::bad_input);
    CHECK(code(compile_with([](KernelInfo&, Dispatch& d, DeviceInfo&) {
              d.indirect = {0, 4088, 12};
          })) == ErrorCode::bad_input);
}

TEST_CASE("group counts fold into two dimensions that cover them without a spare row")
{
    const auto fold = [](std::uint32_t count, std::uint32_t limit) {
        const GroupFold f = fold_groups(count, limit);
        return std::pair(f.x, f.y);
    };
    CHECK(fold(0, 65535) == std::pair(0u, 0u));
    CHECK(fold(1, 65535) == std::pair(1u, 1u));
    CHECK(fold(65535, 65535) == std::pair(65535u, 1u));
    CHECK(fold(65536, 65535) == std::pair(32768u, 2u));
    CHECK(refusal([] { fold_groups(10, 3); }).code == ErrorCode::limit);
    for (const std::uint32_t count : {65537u, 100'000u, 1'000'003u, 67'108'864u, 4'294'836'225u})
    {
        const GroupFold f = fold_groups(count, 65535);
        CAPTURE(count, f.x, f.y);
        CHECK(f.x <= 65535);
        CHECK(f.y <= 65535);
        CHECK(std::uint64_t{f.x} * f.y >= count);
        CHECK(std::uint64_t{f.x} * f.y - count < f.y);
    }
}

TEST_CASE("groups of a dispatch are counted by its kind of kernel")
{
    CHECK(group_count(local::kTally, 1) == 1);
    CHECK(group_count(local::kTally, 64) == 1);
    CHECK(group_count(local::kTally, 65) == 2);
    CHECK(group_count(local::kTally, 0xffffffffu) == 67'108'864u);
    CHECK(group_count(local::kGroupTally, 65) == 65);
}
