#pragma once
// A kernel from a text of the test's own, as users compile theirs.

#include "support/catch.hpp"
#include "taut/runtime/compiler/compiler.hpp"

#include <memory>
#include <string>

namespace taut {

/// The kernel "sample" in its first variant. Throws what compile_kernel throws.
inline std::shared_ptr<const CompiledKernel> compile_sample(const std::string& text,
                                                            Precision precision = Precision::float32)
{
    return compile_kernel({"sample", text, {}, kernel_variants("sample", text).front(), precision});
}

/// What compile_kernel says against a text.
inline std::string sample_refusal(const std::string& text)
{
    try
    {
        compile_sample(text);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::kernel_compilation);
        return error.what();
    }
    FAIL("it compiled");
    return {};
}

} // namespace taut
