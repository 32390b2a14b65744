#pragma once
// The instructions of a SPIR-V module, one after the other.
//
// Based on: SPIR-V Specification, 2.3 (physical layout of a module and an instruction).
// Departures: none.

#include "taut/runtime/base/error.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <spirv/unified1/spirv.hpp>

namespace taut {

/// Magic number, version, generator, bound of ids, schema.
inline constexpr std::size_t kSpirvHeaderWords = 5;

/// The first word of an instruction of so many words, itself counted.
constexpr std::uint32_t spirv_head(spv::Op op, std::size_t words)
{
    return static_cast<std::uint32_t>(words) << 16 | static_cast<std::uint32_t>(op);
}

/// visit(spv::Op, std::size_t place, std::span<const std::uint32_t> operands) for each: `place` is that of
/// its first word, the operands are the words after that. Throws Error{kernel_compilation} for a module that
/// ends within an instruction.
template <typename Visit>
void each_instruction(std::span<const std::uint32_t> spirv, Visit&& visit)
{
    for (std::size_t i = kSpirvHeaderWords; i < spirv.size();)
    {
        const std::uint32_t length = spirv[i] >> 16;
        if (length == 0 || i + length > spirv.size())
            throw Error(ErrorCode::kernel_compilation, "a SPIR-V module is cut off");
        visit(static_cast<spv::Op>(spirv[i] & 0xffffu), i, spirv.subspan(i + 1, length - 1));
        i += length;
    }
}

} // namespace taut
