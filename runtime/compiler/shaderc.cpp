// taut-shaderc: the build's compiler for the shaders that draw (kernels go through taut-kernelc).
//   taut-shaderc OUT.hpp SHADER...     one array of SPIR-V words per shader: surface.vert -> surface_vert
// A shader that glslang or spirv-val rejects stops the build. #include "x" means x in the shader's folder.

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <spirv-tools/libspirv.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

/// The text with its includes in place; #line keeps the compiler's line numbers those of the file.
std::string flat_text(const fs::path& path)
{
    std::ifstream file(path);
    if (!file)
        throw std::runtime_error("cannot read " + path.string());
    std::string line, out;
    for (int number = 1; std::getline(file, line); ++number)
        if (line.rfind("#include \"", 0) == 0)
            out += flat_text(path.parent_path() / line.substr(10, line.find('"', 10) - 10)) + "#line " +
                   std::to_string(number + 1) + "\n";
        else
            out += line + "\n";
    return out;
}

std::vector<std::uint32_t> compile(const fs::path& path)
{
    const EShLanguage stage = path.extension() == ".vert" ? EShLangVertex : EShLangFragment;
    const std::string text = flat_text(path);
    const char* pointer = text.c_str();
    glslang::TShader shader(stage);
    shader.setStrings(&pointer, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 450, false, rules))
        throw std::runtime_error(path.string() + " does not compile:\n" + shader.getInfoLog());
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules))
        throw std::runtime_error(path.string() + " does not link:\n" + program.getInfoLog());
    std::vector<std::uint32_t> spirv;
    glslang::GlslangToSpv(*program.getIntermediate(stage), spirv);

    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    std::string complaint;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { complaint += std::string(message) + "\n"; });
    if (!tools.Validate(spirv))
        throw std::runtime_error(path.string() + ": spirv-val rejects the module:\n" + complaint);
    return spirv;
}

std::string array_text(const fs::path& path)
{
    std::string name = path.filename().string();
    name[name.find('.')] = '_';
    std::ostringstream out;
    out << "inline constexpr std::uint32_t " << name << "[] = {" << std::hex;
    const std::vector<std::uint32_t> spirv = compile(path);
    for (std::size_t i = 0; i < spirv.size(); ++i)
        out << (i % 12 == 0 ? "\n    0x" : " 0x") << spirv[i] << ",";
    out << "\n};\n";
    return out.str();
}

} // namespace

int main(int argc, char** argv)
try
{
    if (argc < 3)
        return std::cerr << "usage: taut-shaderc OUT.hpp SHADER...\n", 2;
    glslang::InitializeProcess();
    std::string text = "#pragma once\n// Generated from runtime/vulkan/shaders. Do not edit.\n\n"
                       "#include <cstdint>\n\nnamespace taut::vulkan::shaders {\n\n";
    for (int i = 2; i < argc; ++i)
        text += array_text(argv[i]);
    std::ofstream file(argv[1]);
    file << text << "\n} // namespace taut::vulkan::shaders\n";
    if (!file.flush())
        throw std::runtime_error(std::string("cannot write ") + argv[1]);
    return 0;
}
catch (const std::exception& error)
{
    std::cerr << error.what() << "\n";
    return 1;
}
