// Execution modes of floats that are added to kernels before Vulkan gets them.

#include "support/catch.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/base/spirv.hpp"
#include "taut/runtime/vulkan/float_controls.hpp"

#include <spirv-tools/libspirv.hpp>

using namespace taut;
using namespace taut::vulkan;

namespace {

bool is_valid(const std::vector<std::uint32_t>& spirv)
{
    const spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_2); // modes need 1.2 or the extension
    return tools.Validate(spirv);
}

int modes_of(const std::vector<std::uint32_t>& spirv, spv::ExecutionMode mode, std::uint32_t width)
{
    int out = 0;
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> operands) {
        out += op == spv::OpExecutionMode && operands[1] == mode && operands[2] == width;
    });
    return out;
}

std::vector<std::uint32_t> words(std::span<const std::uint32_t> spirv)
{
    return {spirv.begin(), spirv.end()};
}

} // namespace

TEST_CASE("a kernel asks for the rounding and the numbers that a device offers to keep")
{
    for (const Precision precision : {Precision::float32, Precision::float64})
    {
        const KernelInfo& kernel = find_kernel("xpbd_spring", "", precision);
        const bool wide = precision == Precision::float64;
        CHECK(with_float_controls(kernel.spirv_vulkan, {}, wide) == words(kernel.spirv_vulkan));
        const FloatControls all = {{true, true, true}, {true, true, true}};
        const std::vector<std::uint32_t> out = with_float_controls(kernel.spirv_vulkan, all, wide);
        CHECK(is_valid(out));
        for (const auto mode : {spv::ExecutionModeRoundingModeRTE, spv::ExecutionModeDenormFlushToZero,
                                spv::ExecutionModeSignedZeroInfNanPreserve})
        {
            CHECK(modes_of(out, mode, 32) == 1);
            CHECK(modes_of(out, mode, 64) == (wide ? 1 : 0)); // a module without doubles may not ask
        }
        const FloatControls some = {{true, false, false}, {}};
        const std::vector<std::uint32_t> less = with_float_controls(kernel.spirv_vulkan, some, wide);
        CHECK(is_valid(less));
        CHECK(modes_of(less, spv::ExecutionModeRoundingModeRTE, 32) == 1);
        CHECK(modes_of(less, spv::ExecutionModeDenormFlushToZero, 32) == 0);
    }
}

TEST_CASE("what a device sets for all widths at once is asked for where all have it")
{
    auto offered = VkPhysicalDeviceFloatControlsProperties{};
    offered.roundingModeIndependence = VK_SHADER_FLOAT_CONTROLS_INDEPENDENCE_NONE;
    offered.denormBehaviorIndependence = VK_SHADER_FLOAT_CONTROLS_INDEPENDENCE_ALL;
    offered.shaderRoundingModeRTEFloat32 = offered.shaderDenormFlushToZeroFloat32 = VK_TRUE;
    const FloatControls out = float_controls(offered);
    CHECK_FALSE(out.float32.rounds_to_even);
    CHECK(out.float32.flushes_denormals);
    CHECK_FALSE(out.float64.flushes_denormals);
    offered.shaderRoundingModeRTEFloat64 = VK_TRUE;
    CHECK(float_controls(offered).float32.rounds_to_even);
}
