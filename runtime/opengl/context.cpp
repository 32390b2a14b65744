#include "taut/runtime/opengl/context.hpp"

#include <algorithm>
#include <cctype>

namespace taut::opengl {
namespace {

constexpr GLuint64 kWaitSlice = 1'000'000'000; // ns; between two looks at whether the device still lives

const char* error_name(GLenum error)
{
    switch (error)
    {
    case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
    case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST: return "GL_CONTEXT_LOST";
    default: return "an unknown error";
    }
}

} // namespace

Context::Context(const Egl& egl, EGLDisplay display, EGLContext context)
    : egl_(egl),
      display_(display),
      context_(context)
{}

Context::~Context()
{
    if (fence_)
    {
        try
        {
            const Use use(*this);
            gl_.DeleteSync(fence_);
        }
        catch (const Error&)
        {
            // A lost context takes its objects with it.
        }
    }
    // The display stays initialised: EGL hands the same one to the host application.
    egl_.DestroyContext(display_, context_);
}

std::shared_ptr<Context> Context::open_on(const Egl& egl, EGLDisplay display, bool validation)
{
    const EGLContext raw = create_context(egl, display, {.debug = validation});
    std::shared_ptr<Context> context(new Context(egl, display, raw));
    const Use use(*context);
    context->load_functions();
    context->renderer_ = context->text(GL_RENDERER);
    context->version_ = context->text(GL_VERSION);
    if (context->number(GL_MAJOR_VERSION) * 10 + context->number(GL_MINOR_VERSION) < 45)
        throw Error(ErrorCode::no_device, "has " + context->version_ + ", OpenGL 4.5 is needed");
    if (validation)
        context->listen();
    return context;
}

std::shared_ptr<Context> Context::open(bool validation)
{
    const Egl& egl = egl_library();
    std::shared_ptr<Context> software;
    std::string reasons;
    for (const NamedDisplay& candidate : windowless_displays(egl))
    {
        EGLDisplay display = candidate.display;
        if (display == EGL_NO_DISPLAY && software)
            break;
        try
        {
            if (display == EGL_NO_DISPLAY)
                display = egl.GetDisplay(EGL_DEFAULT_DISPLAY);
            if (display == EGL_NO_DISPLAY)
                throw Error(ErrorCode::no_device, "is not there");
            auto context = open_on(egl, display, validation);
            if (context->hardware())
                return context;
            if (!software)
                software = std::move(context);
        }
        catch (const Error& error)
        {
            reasons += "; " + candidate.name + " " + error.what();
        }
    }
    if (!software)
        throw Error(ErrorCode::no_device, "no OpenGL 4.5 without a window" + reasons);
    return software;
}

void Context::load_functions()
{
    const auto find = [&](const char* name) { return egl_.GetProcAddress(name); };
#define TAUT_GL_LOAD(name, type)                                                                             \
    gl_.name = reinterpret_cast<PFNGL##type##PROC>(find("gl" #name));                                        \
    if (!gl_.name)                                                                                           \
        throw Error(ErrorCode::no_device, "has no gl" #name);
    TAUT_GL_FUNCTIONS(TAUT_GL_LOAD)
#undef TAUT_GL_LOAD
    // A loader may give an address for any name, so the version and the extension list decide.
    const bool core = number(GL_MAJOR_VERSION) * 10 + number(GL_MINOR_VERSION) >= 46;
    if (core || has_extension("GL_ARB_gl_spirv"))
        gl_.SpecializeShader = reinterpret_cast<PFNGLSPECIALIZESHADERPROC>(
            find(core ? "glSpecializeShader" : "glSpecializeShaderARB"));
}

bool Context::has_extension(std::string_view name) const
{
    const std::int64_t count = number(GL_NUM_EXTENSIONS);
    for (std::int64_t i = 0; i < count; ++i)
    {
        const auto* word = gl_.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (word && name == reinterpret_cast<const char*>(word))
            return true;
    }
    return false;
}

void Context::listen()
{
    gl_.Enable(GL_DEBUG_OUTPUT);
    gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl_.DebugMessageCallback(&Context::on_message, this);
}

void APIENTRY Context::on_message(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar*,
                                  const void* self)
{
    if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM)
        ++const_cast<Context*>(static_cast<const Context*>(self))->messages_;
}

bool Context::hardware() const
{
    std::string name = renderer_;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* software : {"llvmpipe", "softpipe", "swrast", "swr", "software"})
        if (name.find(software) != std::string::npos)
            return false;
    return true;
}

std::string Context::text(GLenum name) const
{
    const auto* text = gl_.GetString(name);
    return text ? reinterpret_cast<const char*>(text) : "";
}

std::int64_t Context::number(GLenum name) const
{
    GLint64 value = 0;
    gl_.GetInteger64v(name, &value);
    return value;
}

bool Context::is_current() const { return current_context(egl_).context == context_; }

Context::Use::Use(Context& context) : context_(context), lock_(context.mutex_)
{
    if (!context_.lost_.empty())
        throw Error(ErrorCode::device_lost, context_.lost_);
    if (context_.depth_ == 0)
    {
        const Egl& egl = context_.egl_;
        context_.before_ = current_context(egl);
        if (context_.before_.context != context_.context_ &&
            !egl.MakeCurrent(context_.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_.context_))
        {
            // libglvnd refuses when the thread has a current GLX context.
            throw Error(ErrorCode::unsupported,
                        "the OpenGL context of the device cannot be current in this thread, EGL error " +
                            egl_error(egl) + ": release a GLX context first or use another thread");
        }
    }
    ++context_.depth_;
}

Context::Use::~Use()
{
    if (--context_.depth_ == 0 && context_.before_.context != context_.context_)
        restore_context(context_.egl_, context_.before_, context_.display_);
}

void Context::lose(const std::string& why)
{
    lost_ = renderer_ + " failed: " + why + "; open the device again";
    throw Error(ErrorCode::device_lost, lost_);
}

void Context::check(std::string_view doing)
{
    const GLenum first = gl_.GetError();
    if (first != GL_NO_ERROR)
        forget_errors();
    if (gl_.GetGraphicsResetStatus() != GL_NO_ERROR)
        lose("the driver reset the device while " + std::string(doing));
    if (first == GL_OUT_OF_MEMORY)
        throw Error(ErrorCode::out_of_memory, renderer_ + " has no memory left while " + std::string(doing) +
                                                  ": make the scene smaller or choose another device");
    if (first != GL_NO_ERROR)
        lose(std::string(error_name(first)) + " while " + std::string(doing));
}

void Context::forget_errors()
{
    int tries = 16; // a lost context may report for ever
    while (gl_.GetError() != GL_NO_ERROR && --tries > 0)
        continue;
}

void Context::submit()
{
    if (fence_)
        gl_.DeleteSync(fence_);
    fence_ = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush();
}

void Context::wait()
{
    while (fence_)
    {
        const GLenum state = gl_.ClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kWaitSlice);
        if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED)
        {
            gl_.DeleteSync(fence_);
            fence_ = nullptr;
        }
        else if (state == GL_WAIT_FAILED || gl_.GetGraphicsResetStatus() != GL_NO_ERROR)
            lose("waiting for its work did not end");
    }
    check("finishing its work");
}

DeviceCounters Context::counters() const
{
    const std::lock_guard lock(mutex_);
    DeviceCounters out = counters_;
    out.validation_messages = messages_;
    out.bytes_reserved = out.bytes_allocated; // what the driver takes for them it does not say
    return out;
}

} // namespace taut::opengl
