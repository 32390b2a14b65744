#include "taut/runtime/vulkan/pipelines.hpp"

#include "taut/runtime/base/spirv.hpp"
#include "taut/runtime/compiler/override.hpp"
#include "taut/runtime/vulkan/structs.hpp"

#include <algorithm>
#include <string_view>

namespace taut::vulkan {
namespace {

std::size_t hash_of(std::span<const std::uint32_t> words)
{
    return std::hash<std::string_view>()(
        std::string_view(reinterpret_cast<const char*>(words.data()), words.size_bytes()));
}

bool uses_float64(std::span<const std::uint32_t> spirv)
{
    bool found = false;
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> operands) {
        found = found || (op == spv::OpCapability && operands[0] == spv::CapabilityFloat64);
    });
    return found;
}

} // namespace

Pipelines::Pipelines(const VolkDeviceTable& vk, VkDevice device, VkPipelineCache cache,
                     const DeviceLimits& limits, const FloatControls& controls, Health& health)
    : vk_(vk),
      device_(device),
      cache_(cache),
      push_bytes_(limits.max_param_bytes),
      float64_(limits.float64),
      controls_(controls),
      health_(health)
{}

Pipelines::~Pipelines()
{
    for (const auto& [hash, entry] : entries_)
        vk_.vkDestroyPipeline(device_, entry.pipeline.handle, nullptr);
    for (const auto& [count, layout] : layouts_)
    {
        vk_.vkDestroyPipelineLayout(device_, layout.pipeline, nullptr);
        vk_.vkDestroyDescriptorSetLayout(device_, layout.set, nullptr);
    }
}

const Pipelines::Layout& Pipelines::layout_for(std::uint32_t binding_count)
{
    // In the map from the start, so that the destructor finds what a failure half-way leaves.
    Layout& layout = layouts_[binding_count];
    if (layout.pipeline != VK_NULL_HANDLE)
        return layout;
    std::vector<VkDescriptorSetLayoutBinding> bindings(binding_count);
    for (std::uint32_t slot = 0; slot < binding_count; ++slot)
        bindings[slot] = {slot, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
    if (binding_count > 0 && layout.set == VK_NULL_HANDLE)
    {
        auto info =
            start<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
        info.bindingCount = binding_count;
        info.pBindings = bindings.data();
        health_.check(vk_.vkCreateDescriptorSetLayout(device_, &info, nullptr, &layout.set),
                      "vkCreateDescriptorSetLayout");
    }
    const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_};
    auto info = start<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = binding_count > 0 ? 1 : 0;
    info.pSetLayouts = &layout.set;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    health_.check(vk_.vkCreatePipelineLayout(device_, &info, nullptr, &layout.pipeline),
                  "vkCreatePipelineLayout");
    return layout;
}

Pipeline Pipelines::make(const KernelInfo& kernel, std::span<const std::uint32_t> spirv)
{
    if (spirv.empty())
        throw Error(ErrorCode::bad_input, "kernel " + std::string(kernel.name) + " has no SPIR-V for Vulkan");
    const bool float64 = uses_float64(spirv);
    if (!float64_ && float64)
        throw Error(ErrorCode::unsupported,
                    "kernel " + std::string(kernel.name) +
                        " uses 64-bit floats, which this device does not have or the host "
                        "did not enable (shaderFloat64); use precision float");
    const Layout& layout = layout_for(static_cast<std::uint32_t>(kernel.bindings.size()));
    auto module_info = start<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    const std::vector<std::uint32_t> words = with_float_controls(spirv, controls_, float64);
    module_info.codeSize = words.size() * sizeof(std::uint32_t);
    module_info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    health_.check(vk_.vkCreateShaderModule(device_, &module_info, nullptr, &module), "vkCreateShaderModule");
    auto info = start<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = layout.pipeline;
    Pipeline pipeline = {VK_NULL_HANDLE, layout.pipeline, layout.set};
    const VkResult result =
        vk_.vkCreateComputePipelines(device_, cache_, 1, &info, nullptr, &pipeline.handle);
    vk_.vkDestroyShaderModule(device_, module, nullptr);
    health_.check(result, "vkCreateComputePipelines");
    return pipeline;
}

Pipeline Pipelines::get(const KernelInfo& kernel)
{
    const std::shared_ptr<const CompiledKernel> edited = kernel_override(kernel);
    const std::span<const std::uint32_t> spirv = edited ? edited->info.spirv_vulkan : kernel.spirv_vulkan;
    const std::lock_guard lock(mutex_);
    const std::size_t hash = hash_of(spirv);
    const auto [first, last] = entries_.equal_range(hash);
    for (auto it = first; it != last; ++it)
        if (std::equal(spirv.begin(), spirv.end(), it->second.spirv.begin(), it->second.spirv.end()))
            return it->second.pipeline;
    std::vector<std::uint32_t> kept(spirv.begin(), spirv.end());
    const Pipeline pipeline = make(kernel, spirv);
    entries_.emplace(hash, Entry{std::move(kept), pipeline});
    return pipeline;
}

} // namespace taut::vulkan
