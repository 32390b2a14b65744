#include "taut/runtime/vulkan/vulkan_device.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/limits.hpp"
#include "taut/runtime/vulkan/pipeline_cache.hpp"
#include "taut/runtime/vulkan/recording.hpp"

#include <algorithm>
#include <filesystem>

namespace taut {
namespace vulkan {
namespace {

class VulkanDevice final : public Device
{
public:
    VulkanDevice(std::shared_ptr<Context> context, DeviceInfo info) : context_(std::move(context))
    {
        info_ = std::move(info);
    }

    ~VulkanDevice() override
    {
        try
        {
            context_->queue->wait_all();
        }
        catch (const Error&)
        {
            // A lost device has nothing to wait for.
        }
        context_->save_cache();
    }

    BufferPtr make_buffer(std::uint64_t bytes, std::string_view label, BufferUse use) override
    {
        if (bytes == 0)
            throw Error(ErrorCode::bad_input,
                        "buffer \"" + std::string(label) + "\" has 0 bytes; ask for at least 1");
        if (bytes > limits().max_buffer_bytes)
            throw Error(ErrorCode::limit, "buffer \"" + std::string(label) + "\" needs " +
                                              std::to_string(bytes) + " bytes, " + info_.name +
                                              " binds at most " + std::to_string(limits().max_buffer_bytes));
        return std::make_shared<VulkanBuffer>(context_, bytes, label, use);
    }

    void write(const BufferPtr& buffer, std::uint64_t offset, std::span<const std::byte> data) override
    {
        const VkBuffer handle = checked(buffer, offset, data.size());
        std::byte* const mapped = vulkan_buffer_of(buffer).mapped();
        if (mapped == nullptr)
            return context_->transfer->upload(handle, offset, data);
        context_->health.require_alive();
        context_->queue->wait_all(); // the step in flight may still read it
        std::copy(data.begin(), data.end(), mapped + offset);
    }

    void read(const BufferPtr& buffer, std::uint64_t offset, std::span<std::byte> data) override
    {
        context_->transfer->download(checked(buffer, offset, data.size()), offset, data);
    }

    std::unique_ptr<Recording> compile(RecordingDesc desc) override
    {
        context_->health.require_alive();
        for (const BufferPtr& buffer : desc.buffers)
            own(buffer);
        check_limits(desc, info_);
        return std::make_unique<VulkanRecording>(context_, std::move(desc));
    }

    void replay(Recording& recording, std::span<const BufferWrite> writes) override
    {
        auto* const own_recording = dynamic_cast<VulkanRecording*>(&recording);
        if (own_recording == nullptr)
            throw Error(ErrorCode::bad_input, "cannot replay: the recording was not compiled by this device");
        for (const BufferWrite& w : writes)
            checked(w.buffer, w.offset, w.bytes.size());
        own_recording->replay(writes);
    }

    void wait() override { context_->queue->wait_all(); }

    DeviceCounters counters() const override
    {
        DeviceCounters out;
        out.submissions = context_->queue->submissions();
        out.dispatches = context_->dispatches;
        out.barriers = context_->barriers;
        out.bytes_allocated = context_->buffer_bytes;
        out.bytes_reserved = context_->memory->block_bytes() + kStagingBytes;
        out.memory_blocks = context_->memory->block_count() + 1; // and the mapped block of Transfer
        out.validation_messages = context_->instance->log ? context_->instance->log->count() : 0;
        return out;
    }

    const std::shared_ptr<Context>& context() const { return context_; }

private:
    VulkanBuffer& own(const BufferPtr& buffer) const
    {
        VulkanBuffer& found = vulkan_buffer_of(buffer);
        if (found.context != context_)
            throw Error(ErrorCode::bad_input,
                        "the buffer belongs to another device; make it on " + info_.name);
        return found;
    }

    VkBuffer checked(const BufferPtr& buffer, std::uint64_t offset, std::uint64_t bytes) const
    {
        const VulkanBuffer& found = own(buffer);
        if (offset > found.bytes() || bytes > found.bytes() - offset)
            throw Error(ErrorCode::bad_input,
                        "bytes " + std::to_string(offset) + " to " + std::to_string(offset + bytes) +
                            " lie outside a buffer of " + std::to_string(found.bytes()) + " bytes");
        return found.handle;
    }

    std::shared_ptr<Context> context_;
};

std::string selector_of(std::size_t index) { return "vulkan:" + std::to_string(index); }

void require_place(const std::string& cache_path)
{
    const std::filesystem::path folder = std::filesystem::absolute(cache_path).parent_path();
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw Error(ErrorCode::io, "pipeline_cache = " + cache_path + ": there is no folder " +
                                       folder.string() + "; make it first");
    if (!is_free_for_file(cache_path))
        throw Error(ErrorCode::io, "pipeline_cache = " + cache_path + ": there is " +
                                       kind_of_file(cache_path) + "; name a file");
    if (!is_pipeline_cache(cache_path))
        throw Error(ErrorCode::io, "pipeline_cache = " + cache_path +
                                       ": the file is no pipeline cache of Taut (it does not begin with " +
                                       "\"TAUTPIPE\") and is left as it is; name another file, or remove it");
}

} // namespace

std::shared_ptr<Context> context_of(const Device& device)
{
    const auto* const own = dynamic_cast<const VulkanDevice*>(&device);
    if (own == nullptr)
        throw Error(ErrorCode::unsupported, "the device is \"" + device.info().executor +
                                                "\", which has no Vulkan handles; open \"vulkan\" for them");
    return own->context();
}

std::shared_ptr<Device> make_device(std::shared_ptr<Context> context, DeviceInfo info)
{
    return std::make_shared<VulkanDevice>(std::move(context), std::move(info));
}

} // namespace vulkan

std::vector<DeviceInfo> list_vulkan()
{
    std::vector<DeviceInfo> out;
    try
    {
        const std::shared_ptr<vulkan::Instance> instance = vulkan::Instance::create(false);
        for (vulkan::PhysicalDevice& device : vulkan::physical_devices(*instance))
        {
            device.info.selector = vulkan::selector_of(out.size());
            out.push_back(std::move(device.info));
        }
    }
    catch (const Error&)
    {
        out.clear(); // open_vulkan repeats the reason
    }
    return out;
}

std::shared_ptr<Device> open_vulkan(std::size_t index, const OpenOptions& options)
{
    if (!options.pipeline_cache.empty())
        vulkan::require_place(options.pipeline_cache);
    std::shared_ptr<vulkan::Instance> instance = vulkan::Instance::create(options.validation);
    std::vector<vulkan::PhysicalDevice> devices = vulkan::physical_devices(*instance);
    if (index >= devices.size())
        throw Error(ErrorCode::no_device, "there is no Vulkan device " + std::to_string(index) +
                                              ": the installed drivers offer " +
                                              std::to_string(devices.size()) +
                                              " with Vulkan 1.1 and compute (vulkaninfo lists them)");
    DeviceInfo info = devices[index].info;
    info.selector = vulkan::selector_of(index);
    return vulkan::make_device(
        vulkan::Context::create(std::move(instance), std::move(devices[index]), options.pipeline_cache),
        std::move(info));
}

std::vector<std::string> validation_messages(const Device& device)
{
    const auto* const own = dynamic_cast<const vulkan::VulkanDevice*>(&device);
    if (own == nullptr || !own->context()->instance->log)
        return {};
    return own->context()->instance->log->texts();
}

} // namespace taut
