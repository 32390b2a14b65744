#include "hardware/radv.hpp"

#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/vulkan/instance.hpp"
#include "taut/runtime/vulkan/pipelines.hpp"
#include "taut/runtime/vulkan/result.hpp"
#include "taut/runtime/vulkan/structs.hpp"
#include "taut/runtime/vulkan/volk.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>

namespace taut::hardware {
namespace {

using vulkan::start;

/// Pipelines is given a table of functions in which this stands for vkCreateComputePipelines: what it makes
/// is what the executor makes, with the one flag that keeps the statistics.
PFN_vkCreateComputePipelines create_pipelines = nullptr;

VKAPI_ATTR VkResult VKAPI_CALL create_with_statistics(VkDevice device, VkPipelineCache cache,
                                                      std::uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks* allocator,
                                                      VkPipeline* pipelines)
{
    std::vector<VkComputePipelineCreateInfo> flagged(infos, infos + count);
    for (VkComputePipelineCreateInfo& info : flagged)
        info.flags |= VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    return create_pipelines(device, cache, count, flagged.data(), allocator, pipelines);
}

void set(const char* variable, const std::string& value) { setenv(variable, value.c_str(), 1); }

/// A logical device with what the executor enables, and the statistics.
class Family
{
public:
    Family(const std::string& family, const std::string& driver_file)
    {
        set("VK_DRIVER_FILES", driver_file);
        set("VK_ICD_FILENAMES", driver_file); // loaders before 1.3.207
        set("RADV_FORCE_FAMILY", family);
        set("MESA_SHADER_CACHE_DISABLE", "true"); // or statistics would be those of another day
        set("RADV_DEBUG", "nocache");
        instance_ = vulkan::Instance::create(false);
        std::vector<vulkan::PhysicalDevice> found = vulkan::physical_devices(*instance_);
        if (found.size() != 1)
            throw Error(ErrorCode::no_device, "RADV_FORCE_FAMILY=" + family + " gives " +
                                                  std::to_string(found.size()) + " devices with " +
                                                  driver_file + "; this Mesa may not know the family");
        physical = found.front();
        open();
    }

    Family(const Family&) = delete;
    Family& operator=(const Family&) = delete;
    ~Family() { vk.vkDestroyDevice(device, nullptr); }

    vulkan::PhysicalDevice physical;
    VkDevice device = VK_NULL_HANDLE;
    VolkDeviceTable vk = {};

private:
    void open()
    {
        const float priority = 1.0f;
        auto queue = start<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
        queue.queueFamilyIndex = physical.queue_family;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        auto statistics = start<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
        statistics.pipelineExecutableInfo = VK_TRUE;
        VkPhysicalDeviceFeatures features = {};
        features.shaderFloat64 = physical.info.limits.float64 ? VK_TRUE : VK_FALSE;
        const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
        auto info = start<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
        info.pNext = &statistics;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        info.pEnabledFeatures = &features;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
        vulkan::check(instance_->table.CreateDevice(physical.handle, &info, nullptr, &device),
                      "vkCreateDevice");
        vulkan::load_device_table(vk, instance_->loader, instance_->handle, device);
        create_pipelines = vk.vkCreateComputePipelines;
        vk.vkCreateComputePipelines = create_with_statistics;
    }

    std::shared_ptr<vulkan::Instance> instance_;
};

struct Statistics
{
    std::map<std::string, double> values;
    std::uint32_t subgroup = 0;

    double of(const char* name) const
    {
        const auto found = values.find(name);
        if (found == values.end())
            throw Error(ErrorCode::unsupported,
                        "the driver tells no statistic \"" + std::string(name) + "\"");
        return found->second;
    }
};

double value_of(const VkPipelineExecutableStatisticKHR& s)
{
    switch (s.format)
    {
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR: return static_cast<double>(s.value.i64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR: return static_cast<double>(s.value.u64);
    case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR: return s.value.f64;
    default: return s.value.b32 == VK_TRUE ? 1 : 0;
    }
}

Statistics statistics_of(const Family& family, VkPipeline pipeline)
{
    auto which = start<VkPipelineInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR);
    which.pipeline = pipeline;
    std::uint32_t count = 1;
    auto properties =
        start<VkPipelineExecutablePropertiesKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR);
    vulkan::check(family.vk.vkGetPipelineExecutablePropertiesKHR(family.device, &which, &count, &properties),
                  "vkGetPipelineExecutablePropertiesKHR");
    Statistics out;
    out.subgroup = properties.subgroupSize;
    auto executable = start<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
    executable.pipeline = pipeline;
    const char* const call = "vkGetPipelineExecutableStatisticsKHR";
    const auto ask = family.vk.vkGetPipelineExecutableStatisticsKHR;
    vulkan::check(ask(family.device, &executable, &count, nullptr), call);
    std::vector<VkPipelineExecutableStatisticKHR> all(
        count, start<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
    vulkan::check(ask(family.device, &executable, &count, all.data()), call);
    for (const VkPipelineExecutableStatisticKHR& s : all)
        out.values[s.name] = value_of(s);
    return out;
}

Row row_of(const std::string& family, const KernelInfo& kernel, const Statistics& s)
{
    const auto whole = [&](const char* name) { return static_cast<std::int64_t>(s.of(name)); };
    Row row;
    row.family = family;
    row.kernel = full_name(kernel);
    row.precision = std::string(to_string(kernel.precision));
    row.numbers = {s.subgroup,
                   whole("VGPRs"),
                   whole("SGPRs"),
                   whole("Spilled VGPRs"),
                   whole("Spilled SGPRs"),
                   whole("Scratch size"),
                   whole("LDS size"),
                   whole("Subgroups per SIMD"),
                   whole("Code size"),
                   whole("Latency"),
                   whole("Inverse Throughput")};
    return row;
}

/// "Mesa 22.3.6" of "radv Mesa 22.3.6, Vulkan 1.3.230".
std::string mesa_of(const std::string& driver)
{
    const std::size_t begin = driver.find("Mesa ");
    return begin == std::string::npos ? driver : driver.substr(begin, driver.find(',', begin) - begin);
}

} // namespace

std::string radv_driver_file()
{
    if (const char* named = std::getenv("TAUT_RADV_DRIVER"); named && *named)
        return named;
    std::vector<std::string> found;
    for (const char* folder :
         {"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"})
    {
        std::error_code error;
        for (const auto& entry : std::filesystem::directory_iterator(folder, error))
            if (entry.path().filename().string().starts_with("radeon_icd"))
                found.push_back(entry.path().string());
    }
    return found.empty() ? "" : *std::min_element(found.begin(), found.end());
}

Compiled compile_all(const std::string& name, const std::string& driver_file)
{
    Family family(name, driver_file);
    vulkan::Health health;
    vulkan::Pipelines pipelines(family.vk, family.device, VK_NULL_HANDLE, family.physical.info.limits,
                                family.physical.float_controls, health);
    Compiled out;
    out.device = family.physical.info.name;
    out.mesa = mesa_of(family.physical.info.driver);
    for (const KernelInfo* kernel : all_kernels())
    {
        try
        {
            const vulkan::Pipeline pipeline = pipelines.get(*kernel);
            out.rows.push_back(row_of(name, *kernel, statistics_of(family, pipeline.handle)));
        }
        catch (const Error& error)
        {
            out.failed.push_back(full_name(*kernel) + " " + std::string(to_string(kernel->precision)) + ": " +
                                 error.what());
        }
    }
    return out;
}

} // namespace taut::hardware
