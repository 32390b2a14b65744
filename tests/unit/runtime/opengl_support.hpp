#pragma once
// What the tests of the OpenGL executor share. They run on whatever driver is here (llvmpipe will do), with
// GLSL text and with SPIR-V; without a driver they say so and pass, unless TAUT_REQUIRE_DEVICE is set.

#include "refusal.hpp"
#include "support/skip.hpp"

#include "taut/runtime/compiler/compiler.hpp"
#include "taut/runtime/opengl/context.hpp"
#include "taut/runtime/opengl/opengl_device.hpp"

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace taut::opengl_test {

/// Null, with a visible reason, where `open` finds no device.
template <typename Open>
auto open_or_skip(Open&& open) -> decltype(open())
{
    try
    {
        return open();
    }
    catch (const Error& error)
    {
        const char* required = std::getenv("TAUT_REQUIRE_DEVICE");
        if (required && *required && std::string(required) != "0")
            throw;
        TAUT_LEFT_OUT(error.what());
        return nullptr;
    }
}

inline std::shared_ptr<Device> open_here(bool spirv, bool validation = false)
{
    OpenOptions options;
    options.validation = validation;
    return open_or_skip([&] { return open_opengl(spirv, options); });
}

inline std::shared_ptr<opengl::Context> context_here(bool validation = false)
{
    return open_or_skip([&] { return opengl::Context::open(validation); });
}

#define TAUT_OPENGL_DEVICE(device)                                                                           \
    const bool spirv = GENERATE(false, true);                                                                \
    CAPTURE(spirv);                                                                                          \
    const std::shared_ptr<Device> device = open_here(spirv);                                                 \
    if (!device)                                                                                             \
    return

inline std::shared_ptr<const CompiledKernel> kernel_of(const std::string& body)
{
    KernelSource source;
    source.name = "test";
    source.text = "#include \"shared/portable.glsl\"\n" + body;
    return compile_kernel(source);
}

struct CountParams
{
    std::uint32_t count;
};

/// Adds i + 1 to values[i].
inline std::shared_ptr<const CompiledKernel> mark_kernel()
{
    return kernel_of("PARAMS { uint count; };\nUPDATE(0, uint, values);\n"
                     "KERNEL(count) { values[i] += i + 1u; }\n");
}

inline std::span<const std::byte> bytes_of(const CountParams& params)
{
    return std::as_bytes(std::span(&params, 1));
}

template <typename T>
BufferPtr buffer_with(Device& device, const std::vector<T>& values, const char* label)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(T), label);
    device.write(buffer, std::span<const T>(values));
    return buffer;
}

} // namespace taut::opengl_test
