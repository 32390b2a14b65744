// Which device a selector means. Only this file knows all executors.

#include "taut/runtime/device.hpp"

#include "taut/runtime/base/flush_denormals.hpp"
#include "taut/runtime/cpu/cpu_device.hpp"
#if TAUT_HAS_OPENGL
#include "taut/runtime/opengl/opengl_device.hpp"
#endif
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

namespace taut {
namespace {

using DevicePtr = std::shared_ptr<Device>;

#if !TAUT_HAS_OPENGL
std::vector<DeviceInfo> list_opengl() { return {}; }

DevicePtr open_opengl(bool, const OpenOptions&)
{
    throw Error(ErrorCode::no_device, "this build has no OpenGL executor: configure with TAUT_OPENGL=ON");
}
#endif

std::string lower(std::string_view text)
{
    std::string out(text);
    for (char& c : out)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

std::string what_there_is()
{
    std::string text;
    for (const DeviceInfo& info : Device::list())
        text += (text.empty() ? "" : ", ") + info.selector + " (" + info.name + ")";
    return text;
}

[[noreturn]] void refuse(const std::string& reason)
{
    throw Error(ErrorCode::no_device, reason + "; there is: " + what_there_is());
}

std::optional<std::size_t> first_hardware(const std::vector<DeviceInfo>& list)
{
    const auto at =
        std::find_if(list.begin(), list.end(), [](const DeviceInfo& d) { return d.hardware_gpu; });
    if (at == list.end())
        return std::nullopt;
    return static_cast<std::size_t>(at - list.begin());
}

/// A GPU that is listed but does not open (no memory, broken driver) is no reason to stop.
DevicePtr try_open(auto&& open)
{
    try
    {
        return open();
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::no_device && error.code() != ErrorCode::unsupported)
            throw;
        return nullptr;
    }
}

DevicePtr open_auto(const OpenOptions& options)
{
    if (const auto gpu = first_hardware(list_vulkan()))
        if (DevicePtr device = try_open([&] { return open_vulkan(*gpu, options); }))
            return device;
    if (first_hardware(list_opengl()))
        if (DevicePtr device = try_open([&] { return open_opengl(false, options); }))
            return device;
    return open_cpu(CpuMode::parallel, options);
}

DevicePtr open_best_vulkan(const OpenOptions& options)
{
    return open_vulkan(first_hardware(list_vulkan()).value_or(0), options);
}

/// `index`: what follows "vulkan:".
DevicePtr open_numbered_vulkan(std::string_view index, const OpenOptions& options)
{
    std::size_t number = 0;
    const char* end = index.data() + index.size();
    const auto [stop, error] = std::from_chars(index.data(), end, number);
    if (error != std::errc() || stop != end)
        throw Error(ErrorCode::no_device,
                    "\"" + std::string(index) + "\" is not the number of a Vulkan device");
    const std::size_t count = list_vulkan().size();
    if (count != 0 && number >= count) // with none at all, open_vulkan knows why
        throw Error(ErrorCode::no_device,
                    "there are " + std::to_string(count) + " Vulkan devices, counted from 0");
    return open_vulkan(number, options);
}

/// Null when `name` (lower case) is not the word of an executor.
DevicePtr open_by_word(std::string_view name, const OpenOptions& options)
{
    constexpr std::string_view kVulkanIndex = "vulkan:";
    if (name == "auto")
        return open_auto(options);
    if (name == "cpu")
        return open_cpu(CpuMode::parallel, options);
    if (name == "cpu:serial")
        return open_cpu(CpuMode::serial, options);
    if (name == "cpu:shuffled")
        return open_cpu(CpuMode::shuffled, options);
    if (name == "opengl")
        return open_opengl(false, options);
    if (name == "opengl:spirv")
        return open_opengl(true, options);
    if (name == "vulkan")
        return open_best_vulkan(options);
    if (name.starts_with(kVulkanIndex))
        return open_numbered_vulkan(name.substr(kVulkanIndex.size()), options);
    return nullptr;
}

} // namespace

void Device::replay(Recording& recording, std::span<const BufferWrite> writes)
{
    for (const BufferWrite& w : writes)
        write(w.buffer, w.offset, w.bytes);
    recording.replay();
}

std::shared_ptr<Device> Device::open(std::string_view selector, const OpenOptions& options)
{
    std::string asked(selector);
    std::string origin = "device \"" + asked + "\"";
    if (asked.empty())
    {
        const char* environment = std::getenv("TAUT_DEVICE");
        asked = environment && *environment ? environment : "auto";
        origin = "device \"" + asked + "\" (from TAUT_DEVICE)";
    }
    const std::string name = lower(asked);
    const FlushDenormals flushed; // for the threads that software drivers start
    try
    {
        if (DevicePtr device = open_by_word(name, options))
            return device;
        for (const DeviceInfo& info : list())
            if (lower(info.name).find(name) != std::string::npos)
                return open_by_word(info.selector, options);
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::no_device)
            throw;
        refuse("cannot open " + origin + ": " + error.what());
    }
    refuse("no device has a name with \"" + asked + "\" in it");
}

std::vector<DeviceInfo> Device::list()
{
    const FlushDenormals flushed; // a driver may keep the threads that it starts here
    std::vector<DeviceInfo> gpus = list_vulkan();
    for (DeviceInfo& info : list_opengl())
        gpus.push_back(std::move(info));
    const auto software = std::stable_partition(gpus.begin(), gpus.end(),
                                                [](const DeviceInfo& info) { return info.hardware_gpu; });
    std::vector<DeviceInfo> all(gpus.begin(), software);
    all.push_back(cpu_info(CpuMode::parallel, 0));
    all.push_back(cpu_info(CpuMode::serial, 0));
    all.insert(all.end(), software, gpus.end());
    all.push_back(cpu_info(CpuMode::shuffled, 0));
    return all;
}

} // namespace taut
