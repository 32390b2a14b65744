// The rules that keep the bits of a kernel out of a driver's hands.

#include "support/kernel_text.hpp"
#include "taut/runtime/base/registry.hpp"
#include "taut/runtime/base/spirv.hpp"

#include <set>
#include <string>

using namespace taut;

namespace {

/// A kernel that stores this.
std::string storing(const std::string& expression)
{
    return "#include \"shared/portable.glsl\"\nPARAMS { uint count; };\n"
           "READ(0, rvec4, first);\nWRITE(1, real, result);\n"
           "KERNEL(count)\n{\n    rvec3 a = rvec3(first[i]), b = a * real(2);\n"
           "    result[i] = " +
           expression + ";\n}\n";
}

std::string refusal(const std::string& expression) { return sample_refusal(storing(expression)); }

/// Float operations of a module, and how many of them may be merged with the next one.
std::pair<int, int> operations(std::span<const std::uint32_t> spirv)
{
    std::set<std::uint32_t> kept;
    int all = 0, open = 0;
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> operands) {
        switch (op)
        {
        case spv::OpDecorate:
            if (operands[1] == spv::DecorationNoContraction)
                CHECK(kept.insert(operands[0]).second); // twice is no valid module
            break;
        case spv::OpFNegate:
        case spv::OpFAdd:
        case spv::OpFSub:
        case spv::OpFMul:
        case spv::OpFDiv:
        case spv::OpVectorTimesScalar:
            ++all;
            open += kept.contains(operands[1]) ? 0 : 1;
            break;
        default: break;
        }
    });
    return {all, open};
}

} // namespace

TEST_CASE("built-in functions whose last bits drivers choose are refused by name")
{
    CHECK(refusal("length(normalize(a))").find("kernel sample uses the built-in normalize()") !=
          std::string::npos);
    CHECK(refusal("distance(a, b)").find("distance()") != std::string::npos);
    CHECK(refusal("mix(a.x, b.x, a.y)").find("mix()") != std::string::npos);
    CHECK(refusal("fma(a.x, b.x, a.y)").find("fma()") != std::string::npos);
    CHECK(refusal("pow(a.x, real(3))").find("pow()") != std::string::npos);
    CHECK(refusal("inversesqrt(a.x)").find("inversesqrt()") != std::string::npos);
    CHECK(refusal("(mat3(1) * a).x").find("product of vectors or matrices") != std::string::npos);
}

TEST_CASE("functions that are exact, and those that the kernels' header writes out, compile")
{
    for (const char* expression :
         {"dot(a, b)", "length(a)", "cross(a, b).x", "sqrt(a.x)", "min(max(abs(a.x), b.y), floor(b.z))"})
        CHECK_NOTHROW(compile_sample(storing(expression)));
}

TEST_CASE("what a kernel computes is precise in the text that OpenGL compiles")
{
    const auto kernel = compile_sample(storing("dot(a, b)"));
    const std::string text = kernel->glsl;
    CHECK(text.find("    PRECISE rvec3 a = rvec3(first[i])") != std::string::npos);
    CHECK(text.find("writeonly buffer name##_block { PRECISE T name[]; }") != std::string::npos);
    const std::string shape(find_kernel("xpbd_hinge").glsl);
    CHECK(shape.find("    PRECISE HingeShape hinge;") != std::string::npos);
    CHECK(shape.find("    rvec3 wing0, wing1;") != std::string::npos); // a member of a structure cannot be
}

TEST_CASE("no float operation of any kernel may be merged with another")
{
    int all = 0;
    for (const KernelInfo* kernel : all_kernels())
        for (const auto& module : {kernel->spirv_vulkan, kernel->spirv_opengl})
        {
            INFO(kernel->name << ":" << kernel->variant);
            const auto [operations_of_it, open] = operations(module);
            all += operations_of_it;
            CHECK(open == 0);
        }
    CHECK(all > 10000);
}
