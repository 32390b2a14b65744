#include "taut/runtime/opengl/program.hpp"

#include <utility>
#include <vector>

namespace taut::opengl {
namespace {

constexpr const char* kParamsBlock = "ParamsBlock"; // kernels/shared/portable.glsl

std::string log_of(GLuint object, PFNGLGETSHADERIVPROC number, PFNGLGETSHADERINFOLOGPROC text)
{
    GLint length = 0;
    number(object, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    if (length > 0)
        text(object, length, nullptr, log.data());
    while (!log.empty() && (log.back() == '\0' || log.back() == '\n'))
        log.pop_back();
    return log.empty() ? "(the driver says nothing more)" : log;
}

} // namespace

Program::Program(std::shared_ptr<Context> context, const KernelInfo& kernel, bool spirv)
    : context_(std::move(context))
{
    const Gl& gl = context_->gl();
    const GLuint shader = gl.CreateShader(GL_COMPUTE_SHADER);
    id_ = gl.CreateProgram();
    try
    {
        compile(shader, kernel, spirv);
        link(shader, kernel);
        if (!spirv) // a SPIR-V module needs no names, so there is nothing to ask for
        {
            check_params(kernel);
            check_buffers(kernel);
        }
        context_->check("compiling kernel " + std::string(kernel.name));
    }
    catch (...)
    {
        gl.DeleteShader(shader);
        gl.DeleteProgram(id_);
        context_->forget_errors(); // what a bad kernel leaves behind is no failure of the device
        throw;
    }
    gl.DeleteShader(shader);
}

Program::~Program()
{
    try
    {
        const Context::Use use(*context_);
        context_->gl().DeleteProgram(id_);
    }
    catch (const Error&)
    {
        // A lost context takes its programs with it.
    }
}

void Program::refuse(const KernelInfo& kernel, const std::string& why) const
{
    throw Error(ErrorCode::kernel_compilation,
                "kernel " + std::string(kernel.name) + " on " + context_->renderer() + ": " + why);
}

void Program::compile(GLuint shader, const KernelInfo& kernel, bool spirv)
{
    const Gl& gl = context_->gl();
    if (spirv ? kernel.spirv_opengl.empty() : kernel.glsl.empty())
        throw Error(ErrorCode::unsupported, "kernel " + std::string(kernel.name) + " has no " +
                                                (spirv ? "SPIR-V" : "GLSL text") + " for OpenGL");
    constexpr std::uint32_t kMagic = 0x07230203; // a driver may crash on what is no module
    if (spirv && kernel.spirv_opengl.front() != kMagic)
        refuse(kernel, "is given words that are no SPIR-V module: they do not begin with 0x07230203");
    if (spirv)
    {
        gl.ShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V, kernel.spirv_opengl.data(),
                        static_cast<GLsizei>(kernel.spirv_opengl.size_bytes()));
        gl.SpecializeShader(shader, "main", 0, nullptr, nullptr);
    }
    else
    {
        const GLchar* text = kernel.glsl.data();
        const auto length = static_cast<GLint>(kernel.glsl.size());
        gl.ShaderSource(shader, 1, &text, &length);
        gl.CompileShader(shader);
    }
    GLint good = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good)
        refuse(kernel, "does not compile:\n" + log_of(shader, gl.GetShaderiv, gl.GetShaderInfoLog));
}

void Program::link(GLuint shader, const KernelInfo& kernel)
{
    const Gl& gl = context_->gl();
    gl.AttachShader(id_, shader);
    gl.LinkProgram(id_);
    GLint good = GL_FALSE;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
    if (!good)
        refuse(kernel, "does not link:\n" + log_of(id_, gl.GetProgramiv, gl.GetProgramInfoLog));
    GLint size[3] = {};
    gl.GetProgramiv(id_, GL_COMPUTE_WORK_GROUP_SIZE, size);
    if (size[0] != static_cast<GLint>(kernel.group_size) || size[1] != 1 || size[2] != 1)
        refuse(kernel, "the driver sees groups of " + std::to_string(size[0]) + ", the table says " +
                           std::to_string(kernel.group_size));
}

GLint Program::resource(GLenum interface, GLuint index, GLenum property) const
{
    GLint value = 0;
    context_->gl().GetProgramResourceiv(id_, interface, index, 1, &property, 1, nullptr, &value);
    return value;
}

void Program::check_params(const KernelInfo& kernel) const
{
    const Gl& gl = context_->gl();
    const GLuint block = gl.GetProgramResourceIndex(id_, GL_UNIFORM_BLOCK, kParamsBlock);
    if (block == GL_INVALID_INDEX)
        return; // no parameters, or none that the kernel uses
    if (const GLint at = resource(GL_UNIFORM_BLOCK, block, GL_BUFFER_BINDING); at != 0)
        refuse(kernel, "parameters sit at uniform binding " + std::to_string(at) + ", expected 0");
    for (const ParamInfo& param : kernel.params)
    {
        const std::string name(param.name);
        const GLchar* text = name.c_str();
        GLuint index = GL_INVALID_INDEX;
        gl.GetUniformIndices(id_, 1, &text, &index);
        if (index == GL_INVALID_INDEX)
            continue;
        GLint offset = -1;
        gl.GetActiveUniformsiv(id_, 1, &index, GL_UNIFORM_OFFSET, &offset);
        if (offset != static_cast<GLint>(param.offset))
            refuse(kernel, "parameter " + name + " sits at byte " + std::to_string(offset) + ", expected " +
                               std::to_string(param.offset));
    }
}

void Program::check_buffers(const KernelInfo& kernel) const
{
    const Gl& gl = context_->gl();
    for (const BindingInfo& binding : kernel.bindings)
    {
        const bool counters = binding.access == Access::count;
        const std::string name = std::string(binding.name) + (counters ? "_counters" : "_block");
        const GLuint block = gl.GetProgramResourceIndex(id_, GL_SHADER_STORAGE_BLOCK, name.c_str());
        if (block == GL_INVALID_INDEX)
            continue; // not used by this variant
        if (const GLint at = resource(GL_SHADER_STORAGE_BLOCK, block, GL_BUFFER_BINDING);
            at != static_cast<GLint>(binding.slot))
            refuse(kernel, "buffer " + name + " sits at binding " + std::to_string(at) + ", expected " +
                               std::to_string(binding.slot));
        if (const GLint stride = element_stride(block);
            stride != 0 && stride != static_cast<GLint>(binding.stride))
            refuse(kernel, "elements of " + name + " are " + std::to_string(stride) +
                               " bytes apart, expected " + std::to_string(binding.stride));
    }
}

GLint Program::element_stride(GLuint block) const
{
    const Gl& gl = context_->gl();
    const GLint count = resource(GL_SHADER_STORAGE_BLOCK, block, GL_NUM_ACTIVE_VARIABLES);
    if (count < 1)
        return 0;
    // Room for all of them: Mesa writes every index, however few it is told to write.
    std::vector<GLint> variables(static_cast<std::size_t>(count));
    const GLenum all = GL_ACTIVE_VARIABLES;
    gl.GetProgramResourceiv(id_, GL_SHADER_STORAGE_BLOCK, block, 1, &all, count, nullptr, variables.data());
    // Any variable will do: all members of an element share the stride of the elements. An array of plain
    // values is the variable itself.
    const auto any = static_cast<GLuint>(variables.front());
    const GLint outer = resource(GL_BUFFER_VARIABLE, any, GL_TOP_LEVEL_ARRAY_STRIDE);
    return outer != 0 ? outer : resource(GL_BUFFER_VARIABLE, any, GL_ARRAY_STRIDE);
}

std::string program_key(const KernelInfo& kernel, bool spirv)
{
    if (!spirv)
        return std::string(kernel.glsl);
    return {reinterpret_cast<const char*>(kernel.spirv_opengl.data()), kernel.spirv_opengl.size_bytes()};
}

} // namespace taut::opengl
