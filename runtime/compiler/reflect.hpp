#pragma once
// Reads bindings, parameters, record layouts and work-group facts out of a SPIR-V module.

#include "taut/runtime/base/kernel_info.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace taut {

struct ReflectedBinding
{
    std::string name;
    std::uint32_t slot = 0;
    Access access = Access::update;
    std::uint32_t stride = 0;
    std::string type; ///< of an element, as GLSL spells it: "Spring", "dvec4", "uint"
    std::vector<std::pair<std::string, std::uint32_t>> members; ///< of a struct: name, offset
};

struct ReflectedParam
{
    std::string name;
    std::string type;
    std::uint32_t offset = 0;
};

struct Reflection
{
    std::vector<ReflectedBinding> bindings; ///< by slot
    std::vector<ReflectedParam> params;
    std::uint32_t param_bytes = 0;
    std::uint32_t group_size = 0;
    std::uint32_t shared_bytes = 0;
    bool group_kernel = false; ///< written with GROUP_KERNEL
};

/// `name` is used in messages. Throws Error{kernel_compilation} for what the kernel rules forbid:
/// gaps in slots, more than 8 buffers, parameters that are not 32-bit scalars.
Reflection reflect(const std::string& name, std::span<const std::uint32_t> spirv);

} // namespace taut
