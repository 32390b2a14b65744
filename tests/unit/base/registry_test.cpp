#include "support/catch.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/registry.hpp"

#include <set>
#include <string>
#include <tuple>

using namespace taut;

TEST_CASE("every built-in kernel is found by its name, variant and precision, and only once")
{
    REQUIRE_FALSE(all_kernels().empty());
    std::set<std::tuple<std::string_view, std::string_view, Precision>> seen;
    for (const KernelInfo* kernel : all_kernels())
    {
        CAPTURE(kernel->name, kernel->variant, to_string(kernel->precision));
        CHECK(seen.insert({kernel->name, kernel->variant, kernel->precision}).second);
        CHECK(&find_kernel(kernel->name, kernel->variant, kernel->precision) == kernel);
    }
}

TEST_CASE("every built-in kernel carries all compiled forms and gapless bindings")
{
    for (const KernelInfo* kernel : all_kernels())
    {
        CAPTURE(kernel->name, kernel->variant);
        CHECK_FALSE(kernel->spirv_vulkan.empty());
        CHECK_FALSE(kernel->spirv_opengl.empty());
        CHECK_FALSE(kernel->glsl.empty());
        CHECK(kernel->native != nullptr);
        CHECK(kernel->bindings.size() <= 8);
        for (std::size_t i = 0; i < kernel->bindings.size(); ++i)
        {
            CHECK(kernel->bindings[i].slot == i);
            CHECK(kernel->bindings[i].stride > 0);
        }
    }
}

TEST_CASE("an unknown kernel is refused by name")
{
    try
    {
        find_kernel("no_such_kernel", "fast", Precision::float64);
        FAIL("it was found");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::unsupported);
        CHECK(std::string(error.what()).find("no_such_kernel") != std::string::npos);
        CHECK(std::string(error.what()).find("fast") != std::string::npos);
    }
}
