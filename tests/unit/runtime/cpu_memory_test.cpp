#include "local_kernels.hpp"
#include "refusal.hpp"
#include "support/catch.hpp"
#include "taut/runtime/cpu/cpu_device.hpp"
#include "taut/runtime/device.hpp"

#include <cstdint>
#include <string>
#include <vector>

using namespace taut;
using local::CountParams;
using test::refusal;
using test::Refusal;

namespace {

std::shared_ptr<Device> open_serial() { return open_cpu(CpuMode::serial, {}); }

} // namespace

TEST_CASE("native buffers are zero and aligned to 64 bytes, and bindings begin at their offset")
{
    const auto device = open_serial();
    static std::uintptr_t address;
    KernelInfo spy = local::kTally;
    spy.native = [](const void*, void* const* buffers, std::uint32_t, std::uint32_t) {
        address = reinterpret_cast<std::uintptr_t>(buffers[0]);
    };
    for (const std::uint64_t bytes : {4u, 100u, 4096u, 1u << 20})
    {
        const BufferPtr buffer = device->make_buffer(bytes, "b");
        CHECK(device->read<std::uint8_t>(buffer, bytes) == std::vector<std::uint8_t>(bytes, 0));
        Recorder recorder(device);
        recorder.dispatch(spy, {buffer}, CountParams{1}, 1);
        recorder.finish()->replay();
        const std::uintptr_t base = address;
        CHECK(base % 64 == 0);
        if (bytes < 100)
            continue;
        recorder.dispatch(spy, {{buffer, 32, 4}}, CountParams{1}, 1);
        recorder.finish()->replay();
        CHECK(address == base + 32);
    }
}

TEST_CASE("a kernel without native code is refused when the list is compiled")
{
    const auto device = open_serial();
    KernelInfo kernel = local::kTally;
    kernel.native = nullptr;
    Recorder recorder(device);
    recorder.dispatch(kernel, {device->make_buffer(64, "b")}, CountParams{1}, 1);
    const Refusal no = refusal([&] { recorder.finish(); });
    CHECK(no.code == ErrorCode::unsupported);
    CHECK(no.says("kernel \"tally\" has no native code"));
    CHECK(recorder.size() == 0);
}

TEST_CASE("a buffer of another device is refused")
{
    const auto here = open_serial(), there = open_serial();
    const BufferPtr foreign = there->make_buffer(64, "foreign");
    Recorder recorder(here);
    recorder.dispatch(local::kTally, {foreign}, CountParams{1}, 1);
    CHECK_THROWS_AS(recorder.finish(), Error);
    CHECK_THROWS_AS(here->read<float>(foreign, 1), Error);
    CHECK_THROWS_AS(here->read<float>(nullptr, 1), Error);
}

TEST_CASE("reads and writes outside a buffer are refused with the numbers")
{
    const auto device = open_serial();
    const BufferPtr buffer = device->make_buffer(64, "b");
    const Refusal no = refusal([&] { device->read<float>(buffer, 9, 32); });
    CHECK(no.code == ErrorCode::bad_input);
    CHECK(no.text == "cannot read 36 bytes at byte 32 of a buffer of 64 bytes");
    CHECK_THROWS_AS(device->write<float>(buffer, std::vector<float>(1), 61), Error);
    CHECK_THROWS_AS(device->write<float>(buffer, std::vector<float>(1), ~std::uint64_t{0}), Error);
    CHECK_NOTHROW(device->write<float>(buffer, std::vector<float>(0), 64));
}

TEST_CASE("impossible buffers are refused")
{
    const auto device = open_serial();
    const std::uint64_t limit = device->limits().max_buffer_bytes;
    CHECK(refusal([&] { device->make_buffer(0, "b"); }).code == ErrorCode::bad_input);
    CHECK(refusal([&] { device->make_buffer(limit + 1, "b"); }).code == ErrorCode::limit);
    CHECK(device->counters().memory_blocks == 0);
}
