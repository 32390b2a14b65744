#include "taut/runtime/compiler/reflect.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/spirv.hpp"

#include <algorithm>
#include <map>

namespace taut {
namespace {

struct Type
{
    spv::Op op = spv::OpNop;
    std::vector<std::uint32_t> operands; ///< after the result id
};

/// The few facts of a module that reflection needs, by id.
struct Module
{
    std::map<std::uint32_t, std::string> names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> member_names;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offsets;
    std::map<std::pair<std::uint32_t, std::uint32_t>, unsigned>
        member_flags; ///< 1 not writable, 2 not readable
    std::map<std::uint32_t, std::uint32_t> bindings, strides, constants;
    std::map<std::uint32_t, Type> types;
    struct Variable
    {
        std::uint32_t id, pointer_type;
        spv::StorageClass storage;
    };
    std::vector<Variable> variables;
    std::uint32_t group_size = 0;
};

std::string literal_string(std::span<const std::uint32_t> words)
{
    std::string text;
    for (const std::uint32_t word : words)
        for (unsigned shift = 0; shift < 32; shift += 8)
        {
            const char c = static_cast<char>((word >> shift) & 0xffu);
            if (c == 0)
                return text;
            text.push_back(c);
        }
    return text;
}

void read_decoration(Module& module, std::span<const std::uint32_t> w)
{
    const auto decoration = static_cast<spv::Decoration>(w[1]);
    if (decoration == spv::DecorationBinding)
        module.bindings[w[0]] = w[2];
    else if (decoration == spv::DecorationArrayStride)
        module.strides[w[0]] = w[2];
}

void read_member_decoration(Module& module, std::span<const std::uint32_t> w)
{
    const std::pair key{w[0], w[1]};
    const auto decoration = static_cast<spv::Decoration>(w[2]);
    if (decoration == spv::DecorationOffset)
        module.offsets[key] = w[3];
    else if (decoration == spv::DecorationNonWritable)
        module.member_flags[key] |= 1u;
    else if (decoration == spv::DecorationNonReadable)
        module.member_flags[key] |= 2u;
}

void read_instruction(Module& module, spv::Op op, std::span<const std::uint32_t> w)
{
    switch (op)
    {
    case spv::OpName: module.names[w[0]] = literal_string(w.subspan(1)); break;
    case spv::OpMemberName: module.member_names[{w[0], w[1]}] = literal_string(w.subspan(2)); break;
    case spv::OpDecorate: read_decoration(module, w); break;
    case spv::OpMemberDecorate: read_member_decoration(module, w); break;
    case spv::OpExecutionMode:
        if (w[1] == spv::ExecutionModeLocalSize)
            module.group_size = w[2] * w[3] * w[4];
        break;
    case spv::OpConstant: module.constants[w[1]] = w[2]; break;
    case spv::OpVariable:
        module.variables.push_back({w[1], w[0], static_cast<spv::StorageClass>(w[2])});
        break;
    case spv::OpTypeInt:
    case spv::OpTypeFloat:
    case spv::OpTypeVector:
    case spv::OpTypeArray:
    case spv::OpTypeRuntimeArray:
    case spv::OpTypeStruct:
    case spv::OpTypePointer: module.types[w[0]] = {op, {w.begin() + 1, w.end()}}; break;
    default: break;
    }
}

Module parse(std::span<const std::uint32_t> spirv)
{
    Module module;
    each_instruction(spirv, [&](spv::Op op, std::size_t, std::span<const std::uint32_t> operands) {
        read_instruction(module, op, operands);
    });
    return module;
}

std::uint32_t size_of(const Module& module, std::uint32_t id)
{
    const Type& type = module.types.at(id);
    switch (type.op)
    {
    case spv::OpTypeInt:
    case spv::OpTypeFloat: return type.operands[0] / 8;
    case spv::OpTypeVector: return size_of(module, type.operands[0]) * type.operands[1];
    case spv::OpTypeArray: return size_of(module, type.operands[0]) * module.constants.at(type.operands[1]);
    case spv::OpTypeStruct:
    {
        std::uint32_t bytes = 0;
        for (const std::uint32_t member : type.operands)
            bytes += size_of(module, member);
        return bytes;
    }
    default: return 0;
    }
}

std::string name_or(const std::map<std::uint32_t, std::string>& names, std::uint32_t id)
{
    const auto found = names.find(id);
    return found == names.end() ? std::string() : found->second;
}

[[noreturn]] void refuse(const std::string& kernel, const std::string& why)
{
    throw Error(ErrorCode::kernel_compilation, "kernel " + kernel + ": " + why);
}

/// A type as GLSL spells it; empty for what neither bindings nor parameters may hold.
std::string spelled(const Module& module, std::uint32_t id)
{
    const Type& type = module.types.at(id);
    switch (type.op)
    {
    case spv::OpTypeInt: return type.operands[1] != 0 ? "int" : "uint";
    case spv::OpTypeFloat: return type.operands[0] == 64 ? "double" : "float";
    case spv::OpTypeStruct: return name_or(module.names, id);
    case spv::OpTypeVector:
    {
        const std::string part = spelled(module, type.operands[0]);
        return (part == "float" ? "" : part.substr(0, 1)) + "vec" + std::to_string(type.operands[1]);
    }
    default: return {};
    }
}

ReflectedBinding reflect_binding(const Module& module, const std::string& kernel, std::uint32_t variable,
                                 std::uint32_t block)
{
    ReflectedBinding binding;
    binding.slot = module.bindings.at(variable);
    binding.name = module.member_names.at({block, 0});
    const std::uint32_t array = module.types.at(block).operands[0];
    if (module.types.at(array).op != spv::OpTypeRuntimeArray)
        refuse(kernel, "buffer " + binding.name + " must be an array; use READ, WRITE or UPDATE");
    binding.stride = module.strides.at(array);
    const auto flags = module.member_flags.find({block, 0});
    const unsigned flag = flags == module.member_flags.end() ? 0 : flags->second;
    binding.access = flag == 1 ? Access::read : flag == 2 ? Access::write : Access::update;
    if (name_or(module.names, block).ends_with("_counters"))
        binding.access = Access::count;
    const std::uint32_t element = module.types.at(array).operands[0];
    const Type& type = module.types.at(element);
    binding.type = spelled(module, element);
    if (type.op == spv::OpTypeStruct)
        for (std::uint32_t m = 0; m < type.operands.size(); ++m)
            binding.members.emplace_back(module.member_names.at({element, m}),
                                         module.offsets.at({element, m}));
    return binding;
}

void reflect_params(const Module& module, const std::string& kernel, std::uint32_t block, Reflection& out)
{
    const Type& type = module.types.at(block);
    for (std::uint32_t m = 0; m < type.operands.size(); ++m)
    {
        const Type& member = module.types.at(type.operands[m]);
        const std::string name = module.member_names.at({block, m});
        const bool scalar = member.op == spv::OpTypeInt || member.op == spv::OpTypeFloat;
        if (!scalar || member.operands[0] != 32)
            refuse(kernel, "parameter " + name + " must be uint, int or float (32-bit scalars only)");
        out.params.push_back({name, spelled(module, type.operands[m]), module.offsets.at({block, m})});
        out.param_bytes = std::max(out.param_bytes, module.offsets.at({block, m}) + 4);
    }
}

} // namespace

Reflection reflect(const std::string& name, std::span<const std::uint32_t> spirv)
{
    const Module module = parse(spirv);
    Reflection out;
    out.group_size = module.group_size;
    // portable.glsl gives the two kinds of kernel an entry function of different names.
    for (const auto& [id, text] : module.names)
        out.group_kernel = out.group_kernel || text.starts_with("body(");
    for (const Module::Variable& variable : module.variables)
    {
        const std::uint32_t pointee = module.types.at(variable.pointer_type).operands[1];
        const auto type = module.types.find(pointee);
        if (variable.storage == spv::StorageClassWorkgroup)
            out.shared_bytes += size_of(module, pointee);
        else if (variable.storage == spv::StorageClassPushConstant)
            reflect_params(module, name, pointee, out);
        else if (type != module.types.end() && type->second.op == spv::OpTypeStruct &&
                 (variable.storage == spv::StorageClassUniform ||
                  variable.storage == spv::StorageClassStorageBuffer))
            out.bindings.push_back(reflect_binding(module, name, variable.id, pointee));
    }
    std::sort(out.bindings.begin(), out.bindings.end(),
              [](const auto& a, const auto& b) { return a.slot < b.slot; });
    if (out.bindings.size() > 8)
        refuse(name, "uses " + std::to_string(out.bindings.size()) + " storage buffers; the limit is 8");
    for (std::size_t i = 0; i < out.bindings.size(); ++i)
        if (out.bindings[i].slot != i)
            refuse(name, "slots must be 0.." + std::to_string(out.bindings.size() - 1) +
                             " without gaps; slot " + std::to_string(i) + " is missing");
    return out;
}

} // namespace taut
