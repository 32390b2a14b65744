#include "taut/runtime/compiler/compiler.hpp"

#include "taut/runtime/compiler/float_rules.hpp"
#include "taut/runtime/compiler/reflect.hpp"
#include "taut/runtime/compiler/variants.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <fstream>
#include <mutex>
#include <regex>
#include <set>
#include <sstream>

namespace taut {
namespace {

/// A text without includes, and for each of its lines where it came from.
struct Flat
{
    std::string text;
    std::vector<std::pair<std::string, int>> origin;

    void add(const std::string& line, const std::string& file, int number)
    {
        text += line;
        text += '\n';
        origin.emplace_back(file, number);
    }
};

[[noreturn]] void refuse(const std::string& why)
{
    throw Error(ErrorCode::kernel_compilation, why);
}

std::string load_include(const std::filesystem::path& root, const std::string& path, const std::string& from)
{
    if (root.empty())
    {
        const std::string_view text = builtin_include(path);
        if (text.empty())
            refuse(from + ": there is no built-in include \"" + path + "\"");
        return std::string(text);
    }
    std::ifstream file(root / path);
    if (!file)
        refuse(from + ": cannot read include \"" + (root / path).string() + "\"");
    return {std::istreambuf_iterator<char>(file), {}};
}

/// REAL(0.1) becomes 0.1f or 0.1lf: the one thing that the GLSL preprocessor cannot do.
std::string with_literals(std::string line, Precision precision)
{
    static constexpr std::string_view kMark = "REAL(";
    for (auto at = line.find(kMark); at != std::string::npos; at = line.find(kMark, at))
    {
        const auto close = line.find(')', at);
        if (close == std::string::npos || line.rfind("//", at) != std::string::npos)
            break;
        const std::string number = line.substr(at + kMark.size(), close - at - kMark.size());
        const std::string literal = "(" + number + (precision == Precision::float64 ? "lf)" : "f)");
        line.replace(at, close - at + 1, literal);
        at += literal.size();
    }
    return line;
}

/// Local variables become PRECISE: for a driver that compiles the text this says what NoContraction says of a
/// SPIR-V module. Of a local variable the line begins with a type, and its name is followed by "=" or ";".
std::string with_precise(const std::string& line)
{
    static const std::regex local(
        R"(^(\s+)((?:real|rvec3|rvec4|rbool)\s+\w+\s*=|[A-Z][A-Za-z]*\s+[a-z]\w*\s*[=;]))");
    return std::regex_replace(line, local, "$1PRECISE $2");
}

/// What a line includes; empty for other lines.
std::string included(const std::string& line, const ElementFile& element)
{
    if (line.rfind("#include", 0) != 0)
        return {};
    if (line == "#include " + element_include(element))
        return element.path;
    const auto quote = line.find('"');
    if (quote == std::string::npos)
        return {};
    return line.substr(quote + 1, line.find('"', quote + 1) - quote - 1);
}

void flatten(Flat& out, const std::string& text, const std::string& file, const KernelSource& source,
             std::set<std::string>& seen)
{
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
    {
        const std::string path = included(line, source.element);
        if (path.empty())
            out.add(with_precise(with_literals(line, source.precision)), file, number);
        else if (seen.insert(path).second)
            flatten(out, load_include(source.include_root, path, file + ":" + std::to_string(number)), path,
                    source, seen);
    }
}

Flat preamble_and_text(const KernelSource& source)
{
    Flat flat;
    const std::string where = source.name + " (preamble)";
    flat.add("#version 450", where, 1);
    flat.add("#define TAUT_GROUP_SIZE " + std::to_string(kGroupSize), where, 2);
    flat.add("#define TAUT_REAL_DOUBLE " + std::string(source.precision == Precision::float64 ? "1" : "0"),
             where, 3);
    for (const auto& [name, value] : source.variant.defines)
        flat.add("#define " + name + " " + value, where, 4);
    if (!source.element.path.empty())
        for (const auto& [name, value] : element_defines(source.element))
            flat.add("#define " + name + " " + value, where, 5);
    std::set<std::string> seen;
    flatten(flat, source.text, source.name + ".comp", source, seen);
    return flat;
}

/// Rewrites "ERROR: 0:57: ..." to "distance.comp:12: ...".
std::string explain(const std::string& log, const Flat& flat)
{
    std::istringstream lines(log);
    std::string line, out;
    while (std::getline(lines, line))
    {
        const auto start = line.find("0:");
        std::size_t number = 0;
        if (start != std::string::npos)
            number = std::strtoul(line.c_str() + start + 2, nullptr, 10);
        if (number >= 1 && number <= flat.origin.size())
        {
            const auto& [file, at] = flat.origin[number - 1];
            const auto rest = line.find(':', start + 2);
            line = file + ":" + std::to_string(at) + (rest == std::string::npos ? "" : line.substr(rest));
        }
        if (!line.empty())
            out += line + "\n";
    }
    return out;
}

std::vector<std::uint32_t> to_spirv(const Flat& flat, const std::string& name, bool vulkan)
{
    static std::once_flag once;
    std::call_once(once, [] { glslang::InitializeProcess(); });

    glslang::TShader shader(EShLangCompute);
    const char* text = flat.text.c_str();
    shader.setStrings(&text, 1);
    const auto client = vulkan ? glslang::EShClientVulkan : glslang::EShClientOpenGL;
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, client, vulkan ? 100 : 450);
    shader.setEnvClient(client, vulkan ? glslang::EShTargetVulkan_1_1 : glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv,
                        vulkan ? glslang::EShTargetSpv_1_3 : glslang::EShTargetSpv_1_0);
    const auto rules =
        static_cast<EShMessages>(EShMsgSpvRules | (vulkan ? EShMsgVulkanRules : EShMsgDefault));
    if (!shader.parse(GetDefaultResources(), 450, false, rules))
        refuse("kernel " + name + " does not compile:\n" + explain(shader.getInfoLog(), flat));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules))
        refuse("kernel " + name + " does not link:\n" + explain(program.getInfoLog(), flat));
    std::vector<std::uint32_t> spirv;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), spirv);
    check_built_ins(name, spirv);
    spirv = without_contraction(spirv);

    spvtools::SpirvTools tools(vulkan ? SPV_ENV_VULKAN_1_1 : SPV_ENV_OPENGL_4_5);
    std::string complaint;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { complaint += std::string(message) + "\n"; });
    if (!tools.Validate(spirv))
        refuse("kernel " + name + ": spirv-val rejects the " + (vulkan ? "Vulkan" : "OpenGL") + " module:\n" +
               complaint);
    return spirv;
}

void fill_tables(CompiledKernel& kernel, const Reflection& reflection)
{
    const auto keep = [&](const std::string& text) -> std::string_view {
        return *kernel.names.emplace_back(std::make_unique<std::string>(text));
    };
    for (const ReflectedBinding& b : reflection.bindings)
    {
        kernel.bindings.push_back({keep(b.name), b.slot, b.access, b.stride});
        kernel.binding_types.push_back(b.type);
        for (const auto& [member, offset] : b.members)
            kernel.layouts.push_back({b.type, member, offset, b.stride});
    }
    for (const ReflectedParam& p : reflection.params)
        kernel.params.push_back({keep(p.name), keep(p.type), p.offset});
}

} // namespace

std::shared_ptr<const CompiledKernel> compile_kernel(const KernelSource& source)
{
    const Flat flat = preamble_and_text(source);
    auto kernel = std::make_shared<CompiledKernel>();
    kernel->name = source.name;
    kernel->variant = source.variant.name;
    kernel->glsl = flat.text;
    kernel->spirv_vulkan = to_spirv(flat, source.name, true);
    kernel->spirv_opengl = to_spirv(flat, source.name, false);
    const Reflection reflection = reflect(source.name, kernel->spirv_vulkan);
    fill_tables(*kernel, reflection);
    KernelInfo& info = kernel->info;
    info.name = kernel->name;
    info.variant = kernel->variant;
    info.precision = source.precision;
    info.group_kernel = reflection.group_kernel;
    info.group_size = reflection.group_size;
    info.shared_bytes = reflection.shared_bytes;
    info.param_bytes = reflection.param_bytes;
    info.bindings = kernel->bindings;
    info.params = kernel->params;
    info.spirv_vulkan = kernel->spirv_vulkan;
    info.spirv_opengl = kernel->spirv_opengl;
    info.glsl = kernel->glsl;
    return kernel;
}

} // namespace taut
