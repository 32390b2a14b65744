#include "taut/runtime/opengl/egl.hpp"

#include "taut/runtime/base/error.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <string_view>

namespace taut::opengl {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw Error(ErrorCode::no_device, why); }

bool has_word(const char* words, std::string_view word)
{
    std::string_view rest = words ? words : "";
    while (!rest.empty())
    {
        const auto end = rest.find(' ');
        if (rest.substr(0, end) == word)
            return true;
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    }
    return false;
}

EGLConfig choose_config(const Egl& egl, EGLDisplay display, const char* extensions)
{
    if (has_word(extensions, "EGL_KHR_no_config_context"))
        return EGL_NO_CONFIG_KHR;
    // The default surface type is "window", which a display without windows never has.
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint found = 0;
    if (!egl.ChooseConfig(display, wanted, &config, 1, &found) || found < 1)
        refuse("no EGL configuration can draw with OpenGL");
    return config;
}

std::vector<EGLint> context_attributes(const ContextWishes& wishes, bool reset_notice)
{
    std::vector<EGLint> list = {EGL_CONTEXT_MAJOR_VERSION,       4,
                                EGL_CONTEXT_MINOR_VERSION,       5,
                                EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    if (wishes.debug)
        list.insert(list.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
    if (reset_notice)
        list.insert(list.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
    list.push_back(EGL_NONE);
    return list;
}

void append_devices(const Egl& egl, std::vector<NamedDisplay>& out)
{
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.GetProcAddress("eglQueryDevicesEXT"));
    std::array<EGLDeviceEXT, 32> devices{};
    EGLint count = 0;
    if (!query || !query(static_cast<EGLint>(devices.size()), devices.data(), &count))
        return;
    for (EGLint i = 0; i < count; ++i)
    {
        void* device = devices[static_cast<std::size_t>(i)];
        const EGLDisplay display = egl.GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
        if (display != EGL_NO_DISPLAY) // which stands for the default display in this list
            out.push_back({display, "EGL device " + std::to_string(i)});
    }
}

} // namespace

Egl load_egl(const char* file)
{
    // Never closed: drivers leave threads and exit handlers behind.
    void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        refuse("cannot open " + std::string(file) + ": install EGL (Debian, Ubuntu: libegl1)");
    Egl egl;
    const auto find = [&](const char* name) {
        void* symbol = dlsym(library, name);
        if (!symbol)
            refuse(std::string(file) + " has no " + name + ": EGL 1.5 is needed");
        return symbol;
    };
#define TAUT_EGL_LOAD(name) egl.name = reinterpret_cast<decltype(egl.name)>(find("egl" #name));
    TAUT_EGL_FUNCTIONS(TAUT_EGL_LOAD)
#undef TAUT_EGL_LOAD
    return egl;
}

const Egl& egl_library()
{
    static const Egl library = load_egl("libEGL.so.1");
    return library;
}

CurrentContext current_context(const Egl& egl)
{
    CurrentContext now;
    now.api = egl.QueryAPI();
    now.context = egl.GetCurrentContext();
    if (now.context == EGL_NO_CONTEXT)
    {
        // The host may have chosen another API after it made an OpenGL context current.
        egl.BindAPI(EGL_OPENGL_API);
        now.context = egl.GetCurrentContext();
    }
    if (now.context != EGL_NO_CONTEXT)
    {
        now.display = egl.GetCurrentDisplay();
        now.draw = egl.GetCurrentSurface(EGL_DRAW);
        now.read = egl.GetCurrentSurface(EGL_READ);
    }
    egl.BindAPI(now.api);
    return now;
}

void restore_context(const Egl& egl, const CurrentContext& before, EGLDisplay own)
{
    if (before.context != EGL_NO_CONTEXT)
        egl.MakeCurrent(before.display, before.draw, before.read, before.context);
    else
    {
        egl.BindAPI(EGL_OPENGL_API); // what "no context" releases depends on the bound API
        egl.MakeCurrent(own, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
    egl.BindAPI(before.api);
}

std::vector<NamedDisplay> windowless_displays(const Egl& egl)
{
    std::vector<NamedDisplay> out;
    const char* extensions = egl.QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (has_word(extensions, "EGL_MESA_platform_surfaceless"))
        if (const EGLDisplay display =
                egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
            display != EGL_NO_DISPLAY)
            out.push_back({display, "EGL surfaceless platform"});
    if (has_word(extensions, "EGL_EXT_platform_device"))
        append_devices(egl, out);
    out.push_back({EGL_NO_DISPLAY, "default EGL display"}); // opened only when it is its turn
    return out;
}

EGLContext create_context(const Egl& egl, EGLDisplay display, const ContextWishes& wishes)
{
    EGLint major = 0, minor = 0;
    if (!egl.Initialize(display, &major, &minor))
        refuse("cannot be initialised, EGL error " + egl_error(egl));
    if (major == 1 && minor < 5)
        refuse("has EGL 1." + std::to_string(minor) + ", 1.5 is needed");
    const char* extensions = egl.QueryString(display, EGL_EXTENSIONS);
    if (!has_word(extensions, "EGL_KHR_surfaceless_context"))
        refuse("lacks EGL_KHR_surfaceless_context");
    const EGLenum api = egl.QueryAPI();
    if (!egl.BindAPI(EGL_OPENGL_API))
        refuse("has no OpenGL, only OpenGL ES");
    EGLContext context = EGL_NO_CONTEXT;
    std::string error;
    try
    {
        const EGLConfig config = choose_config(egl, display, extensions);
        for (const bool reset_notice : {true, false})
            if (context == EGL_NO_CONTEXT)
                context = egl.CreateContext(display, config, EGL_NO_CONTEXT,
                                            context_attributes(wishes, reset_notice).data());
        error = egl_error(egl);
    }
    catch (...)
    {
        egl.BindAPI(api);
        throw;
    }
    egl.BindAPI(api);
    if (context == EGL_NO_CONTEXT)
        refuse("gives no OpenGL 4.5 core context, EGL error " + error);
    return context;
}

std::string egl_error(const Egl& egl)
{
    static constexpr const char* kNames[] = {
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
        "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
        "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};
    const EGLint code = egl.GetError();
    char text[16];
    std::snprintf(text, sizeof(text), "0x%04X", static_cast<unsigned>(code));
    const EGLint at = code - EGL_SUCCESS;
    const bool known = at >= 0 && at < static_cast<EGLint>(std::size(kNames));
    return std::string(text) + (known ? std::string(" (") + kNames[at] + ")" : "");
}

} // namespace taut::opengl
