#pragma once
// Shared by the Vulkan tests: opening with validation, kernels from text, and the check that nothing was
// said.

#include "refusal.hpp"
#include "support/skip.hpp"

#include "taut/runtime/compiler/compiler.hpp"
#include "taut/runtime/device.hpp"
#include "taut/runtime/vulkan/vulkan_device.hpp"

#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

namespace taut::vulkan_test {

/// Null, with a visible reason, where there is no Vulkan, unless TAUT_REQUIRE_DEVICE=1.
inline std::shared_ptr<Device> open_here(bool validation = true, const std::string& pipeline_cache = {})
{
    OpenOptions options;
    options.validation = validation;
    options.pipeline_cache = pipeline_cache;
    try
    {
        return open_vulkan(0, options);
    }
    catch (const Error& error)
    {
        const char* required = std::getenv("TAUT_REQUIRE_DEVICE");
        if (error.code() != ErrorCode::no_device || (required && std::string(required) == "1"))
            throw;
        TAUT_LEFT_OUT(error.what());
        return nullptr;
    }
}

inline std::string said(const Device& device)
{
    std::string text;
    for (const std::string& message : validation_messages(device))
        text += message + "\n";
    return text;
}

/// Opens or leaves the test.
#define TAUT_VULKAN_DEVICE(device)                                                                           \
    const std::shared_ptr<taut::Device> device = taut::vulkan_test::open_here();                             \
    if (!device)                                                                                             \
    return

/// The end of every test that uses the device as it should.
#define CHECK_NOTHING_SAID(device)                                                                           \
    do                                                                                                       \
    {                                                                                                        \
        INFO(taut::vulkan_test::said(*(device)));                                                            \
        CHECK((device)->counters().validation_messages == 0);                                                \
    } while (false)

inline std::shared_ptr<const CompiledKernel> kernel_of(const std::string& name, const std::string& body,
                                                       Precision precision = Precision::float32)
{
    KernelSource source;
    source.name = name;
    source.text = "#include \"shared/portable.glsl\"\n" + body;
    source.precision = precision;
    source.variant = kernel_variants(name, source.text).front();
    return compile_kernel(source);
}

inline constexpr const char* kAffineText = "PARAMS { uint count; float factor; float add; };\n"
                                           "UPDATE(0, float, x);\n"
                                           "KERNEL(count) { x[i] = x[i] * factor + add; }\n";
struct AffineParams
{
    std::uint32_t count = 0;
    float factor = 0;
    float add = 0;
};

/// x <- factor x + add.
inline const KernelInfo& affine()
{
    static const auto kernel = kernel_of("affine", kAffineText);
    return kernel->info;
}

/// Runs `passes` passes x <- 2 x + 1 in one recording, one barrier between each two.
inline std::unique_ptr<Recording> affine_chain(const std::shared_ptr<Device>& device, const BufferPtr& x,
                                               std::uint32_t count, int passes)
{
    Recorder recorder(device);
    for (int i = 0; i < passes; ++i)
        recorder.dispatch(affine(), {x}, AffineParams{count, 2.0f, 1.0f}, count, "chain");
    return recorder.finish();
}

struct CountParams
{
    std::uint32_t count = 0;
};

template <typename T>
BufferPtr upload(Device& device, const std::vector<T>& values)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(T), "test");
    device.write<T>(buffer, values);
    return buffer;
}

using test::Refusal;
using test::refusal;

inline bool contains(const std::string& text, std::string_view part)
{
    return text.find(part) != std::string::npos;
}

} // namespace taut::vulkan_test
