#pragma once
// What is known of a kernel before any device sees it: name, bindings, parameters and the
// compiled forms for the three kinds of executor. Values only; the build generates one table of
// these from kernels/*.comp, and runtime/compiler makes them from text at run time.

#include <cstdint>
#include <span>
#include <string_view>

namespace taut {

/// The floating-point type that `real` stands for in a kernel.
enum class Precision : std::uint8_t
{
    float32,
    float64,
};

/// "float" or "double", as scene files and reports spell it.
constexpr std::string_view to_string(Precision precision)
{
    return precision == Precision::float32 ? "float" : "double";
}

/// Bytes of one `real`.
constexpr std::uint32_t real_bytes(Precision precision)
{
    return precision == Precision::float32 ? 4 : 8;
}

/// How a kernel touches a binding. Barriers follow from this and from nothing else.
enum class Access : std::uint8_t
{
    read = 1,
    write = 2,
    update = 3, ///< read and write
    count = 7,  ///< integer counters, only added to: two such accesses never conflict
};

constexpr bool reads(Access access) { return (static_cast<unsigned>(access) & 1u) != 0; }
constexpr bool writes(Access access) { return (static_cast<unsigned>(access) & 2u) != 0; }

/// Invocations of a KERNEL's work group on a device. Kernels see it as TAUT_GROUP_SIZE.
inline constexpr std::uint32_t kGroupSize = 64;

/// Loop trips that one invocation may make in one dispatch: lavapipe stops silently at 65,535 in all.
inline constexpr std::uint32_t kMaxLoopTrips = 32000;

struct BindingInfo
{
    std::string_view name; ///< as written in READ, WRITE, UPDATE or COUNTERS
    std::uint32_t slot;    ///< storage buffer binding, 0..7
    Access access;
    std::uint32_t stride; ///< bytes of one element
};

struct ParamInfo
{
    std::string_view name;
    std::string_view type; ///< "uint", "int" or "float"
    std::uint32_t offset;  ///< bytes
};

/// Native form of a kernel. Runs elements (KERNEL) or groups (GROUP_KERNEL) begin..end-1.
/// `params` points to param_bytes bytes; buffers[slot] is the first byte of each binding.
using NativeKernel = void (*)(const void* params, void* const* buffers, std::uint32_t begin,
                              std::uint32_t end);

struct KernelInfo
{
    std::string_view name;    ///< stem of kernels/**/<name>.comp; also the timing label
    std::string_view variant; ///< "" or the word of a `//! variant` line
    Precision precision = Precision::float32;
    bool group_kernel = false;     ///< GROUP_KERNEL: dispatched by groups, not by elements
    std::uint32_t group_size = kGroupSize;
    std::uint32_t shared_bytes = 0; ///< work-group memory
    std::uint32_t param_bytes = 0;
    std::span<const BindingInfo> bindings; ///< in order of slot, slots 0..n-1 without gaps
    std::span<const ParamInfo> params;
    std::span<const std::uint32_t> spirv_vulkan;
    std::span<const std::uint32_t> spirv_opengl;
    std::string_view glsl; ///< for OpenGL: one text, includes flattened, with #version
    NativeKernel native = nullptr; ///< null for kernels that were compiled at run time
};

} // namespace taut
