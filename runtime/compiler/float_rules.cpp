#include "taut/runtime/compiler/float_rules.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/spirv.hpp"

#include <algorithm>
#include <set>
#include <spirv/unified1/GLSL.std.450.h>

namespace taut {
namespace {

/// Functions of GLSL.std.450 that are exact, or rounded correctly (float_rules.hpp on Sqrt).
bool is_exact(std::uint32_t function)
{
    switch (function)
    {
    case GLSLstd450RoundEven:
    case GLSLstd450Trunc:
    case GLSLstd450FAbs:
    case GLSLstd450SAbs:
    case GLSLstd450FSign:
    case GLSLstd450SSign:
    case GLSLstd450Floor:
    case GLSLstd450Ceil:
    case GLSLstd450Sqrt:
    case GLSLstd450UnpackDouble2x32:
    case GLSLstd450FMin:
    case GLSLstd450UMin:
    case GLSLstd450SMin:
    case GLSLstd450FMax:
    case GLSLstd450UMax:
    case GLSLstd450SMax:
    case GLSLstd450FClamp:
    case GLSLstd450UClamp:
    case GLSLstd450SClamp: return true;
    default: return false;
    }
}

/// What GLSL calls a function that kernels may be tempted to use.
std::string glsl_name(std::uint32_t function)
{
    switch (function)
    {
    case GLSLstd450Cross: return "cross()";
    case GLSLstd450Normalize: return "normalize()";
    case GLSLstd450Distance: return "distance()";
    case GLSLstd450Length: return "length()";
    case GLSLstd450FMix: return "mix()";
    case GLSLstd450Fma: return "fma()";
    case GLSLstd450Pow: return "pow()";
    case GLSLstd450Exp: return "exp()";
    case GLSLstd450Log: return "log()";
    case GLSLstd450InverseSqrt: return "inversesqrt()";
    case GLSLstd450Sin: return "sin()";
    case GLSLstd450Cos: return "cos()";
    case GLSLstd450Tan: return "tan()";
    case GLSLstd450Atan:
    case GLSLstd450Atan2: return "atan()";
    case GLSLstd450SmoothStep: return "smoothstep()";
    case GLSLstd450Reflect: return "reflect()";
    default: return "number " + std::to_string(function) + " of GLSL.std.450";
    }
}

bool adds_products(spv::Op op)
{
    return op == spv::OpDot || op == spv::OpVectorTimesMatrix || op == spv::OpMatrixTimesVector ||
           op == spv::OpMatrixTimesMatrix;
}

bool is_float_operation(spv::Op op)
{
    switch (op)
    {
    case spv::OpFNegate:
    case spv::OpFAdd:
    case spv::OpFSub:
    case spv::OpFMul:
    case spv::OpFDiv:
    case spv::OpFRem:
    case spv::OpFMod:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar: return true;
    default: return false;
    }
}

} // namespace

void check_built_ins(const std::string& kernel, std::span<const std::uint32_t> spirv)
{
    const auto refuse = [&](const std::string& what) {
        throw Error(ErrorCode::kernel_compilation,
                    "kernel " + kernel + " uses the built-in " + what +
                        ", whose last bits each driver chooses; write it out (shared/portable.glsl has "
                        "dot, length and cross)");
    };
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> w) {
        if (op == spv::OpExtInst && !is_exact(w[3])) // result type, result, set, function
            refuse(glsl_name(w[3]));
        if (adds_products(op))
            refuse("product of vectors or matrices");
    });
}

std::vector<std::uint32_t> without_contraction(std::span<const std::uint32_t> spirv)
{
    std::set<std::uint32_t> decorated;
    std::vector<std::uint32_t> results;
    std::size_t end_of_decorations = 0;
    each_instruction(spirv, [&](spv::Op op, std::size_t at, std::span<const std::uint32_t> w) {
        if (op == spv::OpDecorate || op == spv::OpMemberDecorate)
            end_of_decorations = at + 1 + w.size();
        if (op == spv::OpDecorate && w[1] == spv::DecorationNoContraction)
            decorated.insert(w[0]);
        if (is_float_operation(op))
            results.push_back(w[1]); // after the result's type
    });
    if (end_of_decorations == 0) // no buffers: not a kernel
        return {spirv.begin(), spirv.end()};
    const auto place = spirv.begin() + static_cast<std::ptrdiff_t>(end_of_decorations);
    std::vector<std::uint32_t> out(spirv.begin(), place);
    for (const std::uint32_t id : results)
        if (!decorated.contains(id))
            out.insert(out.end(), {spirv_head(spv::OpDecorate, 3), id,
                                   static_cast<std::uint32_t>(spv::DecorationNoContraction)});
    out.insert(out.end(), place, spirv.end());
    return out;
}

} // namespace taut
