#pragma once
// A device on paper: buffers have a size and the contents that were written to them, recordings are lists.
// Nothing can run. The plan lets src/linear record into it, so that what a solve needs becomes plan data like
// everything else, countable and checked for hazards before any device exists.

#include "taut/runtime/device.hpp"

namespace taut {

class PaperDevice final : public Device
{
public:
    /// `info` says what recordings must reckon with: limits, precision, software or hardware.
    explicit PaperDevice(DeviceInfo info) { info_ = std::move(info); }

    BufferPtr make_buffer(std::uint64_t bytes, std::string_view label, BufferUse use) override;
    void write(const BufferPtr&, std::uint64_t offset, std::span<const std::byte>) override;
    /// Gives what was written; nothing ever runs.
    void read(const BufferPtr&, std::uint64_t offset, std::span<std::byte>) override;
    using Device::read;
    using Device::write;
    /// Throws what a real device with these limits would throw. Take the list with take().
    std::unique_ptr<Recording> compile(RecordingDesc) override;
    void wait() override {}
    DeviceCounters counters() const override { return {}; }

    /// What a recorder of this device collected; it is empty afterwards.
    static RecordingDesc take(Recorder&);
    /// Empty: all zero.
    static const std::vector<std::byte>& contents(const BufferPtr&);
    static const std::string& label(const BufferPtr&);
};

} // namespace taut
