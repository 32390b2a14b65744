#include "taut/runtime/cpu/cpu_device.hpp"

#include "taut/runtime/compiler/override.hpp"
#include "taut/runtime/cpu/recording.hpp"
#include "taut/runtime/limits.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>
#include <utility>

namespace taut {
namespace {

constexpr unsigned kMaxThreads = 1024;

unsigned hardware_threads() { return std::clamp(std::thread::hardware_concurrency(), 1u, kMaxThreads); }

std::string processor_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            if (const std::size_t colon = line.find(": "); colon != std::string::npos)
                return line.substr(colon + 2);
    return "CPU";
}

std::string selector_of(CpuMode mode)
{
    switch (mode)
    {
    case CpuMode::serial: return "cpu:serial";
    case CpuMode::shuffled: return "cpu:shuffled";
    case CpuMode::parallel: break;
    }
    return "cpu";
}

/// Only memory limits the native executor. The offset alignment is that of the strictest record.
DeviceLimits cpu_limits()
{
    DeviceLimits limits;
    limits.max_buffer_bytes = std::uint64_t{1} << 40;
    limits.offset_alignment = 16;
    limits.max_groups_per_dimension = std::uint32_t{1} << 31;
    limits.max_group_size = 1024;
    limits.max_shared_bytes = std::uint32_t{1} << 20; // lives on a thread's stack
    limits.max_param_bytes = 128;
    limits.max_bindings = cpu::kMaxBindings;
    limits.float64 = true;
    return limits;
}

std::unique_ptr<cpu::Runner> make_runner(CpuMode mode, const OpenOptions& options)
{
    switch (mode)
    {
    case CpuMode::serial: return cpu::make_serial_runner();
    case CpuMode::shuffled: return cpu::make_shuffled_runner(options.seed);
    case CpuMode::parallel: break;
    }
    return cpu::make_parallel_runner(options.threads != 0 ? options.threads : hardware_threads());
}

/// Native code was compiled with the program: an edited text would be left out without a word.
void refuse_kernel_texts(const RecordingDesc& desc)
{
    std::set<const KernelInfo*> kernels;
    for (const Dispatch& dispatch : desc.dispatches)
        kernels.insert(dispatch.kernel);
    for (const KernelInfo* kernel : kernels)
        if (const std::filesystem::path text = kernel_override_file(*kernel); !text.empty())
            throw Error(
                ErrorCode::unsupported,
                "TAUT_KERNEL_DIR holds " + text.string() +
                    ", but the native executor runs only the kernels that were built in; use vulkan or "
                    "opengl, or unset the variable");
}

class CpuDevice final : public Device
{
public:
    CpuDevice(CpuMode mode, const OpenOptions& options) : engine_(std::make_shared<cpu::Engine>())
    {
        info_ = cpu_info(mode, options.threads);
        engine_->runner = make_runner(mode, options);
    }

    BufferPtr make_buffer(std::uint64_t bytes, std::string_view label, BufferUse) override
    {
        if (bytes == 0)
            throw Error(ErrorCode::bad_input,
                        "buffer \"" + std::string(label) + "\" has 0 bytes: a buffer needs at least 1");
        if (bytes > limits().max_buffer_bytes)
            throw Error(ErrorCode::limit, "buffer \"" + std::string(label) + "\" of " +
                                              std::to_string(bytes) +
                                              " bytes exceeds the limit of this device, " +
                                              std::to_string(limits().max_buffer_bytes) + " bytes");
        return std::make_shared<cpu::CpuBuffer>(bytes, label, engine_->stats);
    }

    using Device::read;
    using Device::write;

    void write(const BufferPtr& buffer, std::uint64_t offset, std::span<const std::byte> bytes) override
    {
        std::byte* const to = address(buffer, offset, bytes.size(), "write");
        const std::lock_guard lock(engine_->mutex);
        if (!bytes.empty())
            std::memcpy(to, bytes.data(), bytes.size());
    }

    void read(const BufferPtr& buffer, std::uint64_t offset, std::span<std::byte> bytes) override
    {
        const std::byte* const from = address(buffer, offset, bytes.size(), "read");
        const std::lock_guard lock(engine_->mutex);
        if (!bytes.empty())
            std::memcpy(bytes.data(), from, bytes.size());
    }

    std::unique_ptr<Recording> compile(RecordingDesc desc) override
    {
        check_limits(desc, info_);
        refuse_kernel_texts(desc);
        return std::make_unique<cpu::CpuRecording>(std::move(desc), engine_);
    }

    /// replay() returns when the work is done; what is left is a replay on another thread.
    void wait() override { const std::lock_guard lock(engine_->mutex); }

    DeviceCounters counters() const override
    {
        const cpu::Stats& stats = *engine_->stats;
        DeviceCounters out;
        out.submissions = stats.submissions;
        out.dispatches = stats.dispatches;
        out.barriers = stats.barriers;
        out.bytes_allocated = out.bytes_reserved = stats.bytes;
        out.memory_blocks = stats.blocks;
        return out;
    }

private:
    std::byte* address(const BufferPtr& buffer, std::uint64_t offset, std::uint64_t bytes,
                       const char* verb) const
    {
        const auto* mine = dynamic_cast<const cpu::CpuBuffer*>(buffer.get());
        if (!mine || mine->owner() != engine_->stats.get())
            throw Error(ErrorCode::bad_input,
                        std::string("cannot ") + verb + ": the buffer was not made by this device");
        if (offset > mine->bytes() || bytes > mine->bytes() - offset)
            throw Error(ErrorCode::bad_input, std::string("cannot ") + verb + " " + std::to_string(bytes) +
                                                  " bytes at byte " + std::to_string(offset) +
                                                  " of a buffer of " + std::to_string(mine->bytes()) +
                                                  " bytes");
        return mine->data() + offset;
    }

    std::shared_ptr<cpu::Engine> engine_;
};

} // namespace

DeviceInfo cpu_info(CpuMode mode, unsigned threads)
{
    const unsigned used = mode != CpuMode::parallel ? 1 : threads != 0 ? threads : hardware_threads();
    DeviceInfo info;
    info.selector = info.executor = selector_of(mode);
    info.name = processor_name();
    info.driver = "native code, " + std::to_string(used) + (used == 1 ? " thread" : " threads");
    info.limits = cpu_limits();
    return info;
}

std::shared_ptr<Device> open_cpu(CpuMode mode, const OpenOptions& options)
{
    if (options.threads > kMaxThreads)
        throw Error(ErrorCode::bad_input, "threads is " + std::to_string(options.threads) +
                                              ": use 0 (all cores) to " + std::to_string(kMaxThreads));
    return std::make_shared<CpuDevice>(mode, options);
}

} // namespace taut
