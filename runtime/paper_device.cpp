#include "taut/runtime/paper_device.hpp"

#include "taut/runtime/limits.hpp"

#include <algorithm>

namespace taut {
namespace {

struct PaperBuffer final : Buffer
{
    PaperBuffer(std::uint64_t bytes, std::string_view name) : Buffer(bytes), label(name) {}
    std::string label;
    std::vector<std::byte> contents;
};

struct PaperRecording final : Recording
{
    void replay() override { refuse(); }
    std::vector<DispatchTime> replay_timed() override { refuse(); }
    [[noreturn]] static void refuse()
    {
        throw Error(ErrorCode::unsupported, "a recording on paper cannot run; record it for a device");
    }
    RecordingDesc desc;
};

PaperBuffer& on_paper(const BufferPtr& buffer)
{
    auto* own = dynamic_cast<PaperBuffer*>(buffer.get());
    if (own == nullptr)
        throw Error(ErrorCode::bad_input, "the buffer is of another device");
    return *own;
}

void check_range(const Buffer& buffer, std::uint64_t offset, std::uint64_t bytes)
{
    if (offset > buffer.bytes() || bytes > buffer.bytes() - offset)
        throw Error(ErrorCode::bad_input, "bytes " + std::to_string(offset) + " to " +
                                              std::to_string(offset + bytes) + " of a buffer of " +
                                              std::to_string(buffer.bytes()));
}

} // namespace

BufferPtr PaperDevice::make_buffer(std::uint64_t bytes, std::string_view label, BufferUse)
{
    if (bytes == 0)
        throw Error(ErrorCode::bad_input, "buffer " + std::string(label) + " has no bytes");
    if (bytes > limits().max_buffer_bytes)
        throw Error(ErrorCode::limit, "buffer " + std::string(label) + " needs " + std::to_string(bytes) +
                                          " bytes, the device binds at most " +
                                          std::to_string(limits().max_buffer_bytes));
    return std::make_shared<PaperBuffer>(bytes, label);
}

void PaperDevice::write(const BufferPtr& buffer, std::uint64_t offset, std::span<const std::byte> bytes)
{
    PaperBuffer& own = on_paper(buffer);
    check_range(own, offset, bytes.size());
    own.contents.resize(own.bytes());
    std::copy(bytes.begin(), bytes.end(), own.contents.begin() + static_cast<std::ptrdiff_t>(offset));
}

void PaperDevice::read(const BufferPtr& buffer, std::uint64_t offset, std::span<std::byte> out)
{
    const PaperBuffer& own = on_paper(buffer);
    check_range(own, offset, out.size());
    std::fill(out.begin(), out.end(), std::byte{0});
    if (!own.contents.empty())
        std::copy_n(own.contents.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
}

std::unique_ptr<Recording> PaperDevice::compile(RecordingDesc desc)
{
    check_limits(desc, info());
    auto recording = std::make_unique<PaperRecording>();
    recording->desc = std::move(desc);
    return recording;
}

RecordingDesc PaperDevice::take(Recorder& recorder)
{
    const std::unique_ptr<Recording> recording = recorder.finish();
    auto* own = dynamic_cast<PaperRecording*>(recording.get());
    if (own == nullptr)
        throw Error(ErrorCode::bad_input, "the recorder is of another device");
    return std::move(own->desc);
}

const std::vector<std::byte>& PaperDevice::contents(const BufferPtr& buffer)
{
    return on_paper(buffer).contents;
}
const std::string& PaperDevice::label(const BufferPtr& buffer) { return on_paper(buffer).label; }

} // namespace taut
