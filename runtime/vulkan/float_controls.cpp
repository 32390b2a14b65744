#include "taut/runtime/vulkan/float_controls.hpp"

#include "taut/runtime/base/spirv.hpp"

#include <cstring>
#include <string_view>

namespace taut::vulkan {
namespace {

void add_extension(std::vector<std::uint32_t>& out)
{
    constexpr std::string_view kName = "SPV_KHR_float_controls";
    std::vector<std::uint32_t> text(kName.size() / 4 + 1, 0); // ends in a zero byte
    std::memcpy(text.data(), kName.data(), kName.size());
    out.push_back(spirv_head(spv::OpExtension, 1 + text.size()));
    out.insert(out.end(), text.begin(), text.end());
}

struct Mode
{
    spv::Capability capability;
    spv::ExecutionMode mode;
    bool float32, float64;
};

/// Where the parts of a module begin that are added to, in words, and what is its entry point.
struct Places
{
    std::size_t capabilities_end = kSpirvHeaderWords, entry_end = 0;
    std::uint32_t entry = 0;
};

Places find_places(std::span<const std::uint32_t> spirv)
{
    Places out;
    each_instruction(spirv, [&](spv::Op op, std::size_t place, std::span<const std::uint32_t> operands) {
        if (op == spv::OpCapability)
            out.capabilities_end = place + 1 + operands.size();
        if (op == spv::OpEntryPoint)
        {
            out.entry = operands[1];
            out.entry_end = place + 1 + operands.size();
        }
    });
    return out;
}

} // namespace

FloatControls float_controls(const VkPhysicalDeviceFloatControlsProperties& p)
{
    FloatControls out;
    out.float32 = {p.shaderRoundingModeRTEFloat32 == VK_TRUE, p.shaderDenormFlushToZeroFloat32 == VK_TRUE,
                   p.shaderSignedZeroInfNanPreserveFloat32 == VK_TRUE};
    out.float64 = {p.shaderRoundingModeRTEFloat64 == VK_TRUE, p.shaderDenormFlushToZeroFloat64 == VK_TRUE,
                   p.shaderSignedZeroInfNanPreserveFloat64 == VK_TRUE};
    // "32 bits only": the widths other than 32 go together, and ours is one. "None": all go together.
    if (p.roundingModeIndependence == VK_SHADER_FLOAT_CONTROLS_INDEPENDENCE_NONE)
        out.float32.rounds_to_even = out.float64.rounds_to_even =
            out.float32.rounds_to_even && out.float64.rounds_to_even;
    if (p.denormBehaviorIndependence == VK_SHADER_FLOAT_CONTROLS_INDEPENDENCE_NONE)
        out.float32.flushes_denormals = out.float64.flushes_denormals =
            out.float32.flushes_denormals && out.float64.flushes_denormals;
    return out;
}

std::vector<std::uint32_t> with_float_controls(std::span<const std::uint32_t> spirv,
                                               const FloatControls& controls, bool float64)
{
    const FloatControls::Width narrow = controls.float32;
    const FloatControls::Width wide = float64 ? controls.float64 : FloatControls::Width{};
    const Mode modes[] = {
        {spv::CapabilityRoundingModeRTE, spv::ExecutionModeRoundingModeRTE, narrow.rounds_to_even,
         wide.rounds_to_even},
        {spv::CapabilityDenormFlushToZero, spv::ExecutionModeDenormFlushToZero, narrow.flushes_denormals,
         wide.flushes_denormals},
        {spv::CapabilitySignedZeroInfNanPreserve, spv::ExecutionModeSignedZeroInfNanPreserve,
         narrow.keeps_zeros_and_nan, wide.keeps_zeros_and_nan},
    };
    const Places at = find_places(spirv);
    std::vector<std::uint32_t> capabilities, execution;
    for (const Mode& m : modes)
    {
        if (m.float32 || m.float64)
            capabilities.insert(capabilities.end(), {spirv_head(spv::OpCapability, 2), m.capability});
        for (const std::uint32_t width : {32u, 64u})
            if (width == 32 ? m.float32 : m.float64)
                execution.insert(execution.end(), {spirv_head(spv::OpExecutionMode, 4), at.entry,
                                                   static_cast<std::uint32_t>(m.mode), width});
    }
    if (capabilities.empty() || at.entry_end == 0)
        return {spirv.begin(), spirv.end()};
    add_extension(capabilities);
    std::vector<std::uint32_t> out(spirv.begin(), spirv.end());
    const auto place = [&](std::size_t words) { return out.begin() + static_cast<std::ptrdiff_t>(words); };
    out.insert(place(at.entry_end), execution.begin(), execution.end()); // the later place first
    out.insert(place(at.capabilities_end), capabilities.begin(), capabilities.end());
    return out;
}

} // namespace taut::vulkan
