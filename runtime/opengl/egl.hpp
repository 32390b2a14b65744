#pragma once
// libEGL, opened at run time: a program that never asks for OpenGL does not need it.

#ifndef EGL_NO_X11
#define EGL_NO_X11 // X11's headers define None, Success and Status
#endif
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <string>
#include <vector>

namespace taut::opengl {

#define TAUT_EGL_FUNCTIONS(X)                                                                                \
    X(GetProcAddress)                                                                                        \
    X(QueryString)                                                                                           \
    X(GetError)                                                                                              \
    X(GetDisplay)                                                                                            \
    X(GetPlatformDisplay)                                                                                    \
    X(Initialize)                                                                                            \
    X(BindAPI)                                                                                               \
    X(QueryAPI)                                                                                              \
    X(ChooseConfig)                                                                                          \
    X(CreateContext)                                                                                         \
    X(DestroyContext)                                                                                        \
    X(MakeCurrent)                                                                                           \
    X(GetCurrentContext)                                                                                     \
    X(GetCurrentDisplay)                                                                                     \
    X(GetCurrentSurface)

struct Egl
{
#define TAUT_EGL_MEMBER(name) decltype(&egl##name) name = nullptr;
    TAUT_EGL_FUNCTIONS(TAUT_EGL_MEMBER)
#undef TAUT_EGL_MEMBER
};

/// Loads a library by its file name. Throws Error{no_device} when it or one of its functions is missing.
Egl load_egl(const char* file);

/// "libEGL.so.1", loaded on first use and never closed.
const Egl& egl_library();

/// The current context of a thread and everything needed to make it current again.
struct CurrentContext
{
    EGLenum api = EGL_OPENGL_ES_API;
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLSurface draw = EGL_NO_SURFACE;
    EGLSurface read = EGL_NO_SURFACE;
    EGLContext context = EGL_NO_CONTEXT;
};

CurrentContext current_context(const Egl& egl);

/// `own` is the display of the context that is current now and is released if nothing was before.
void restore_context(const Egl& egl, const CurrentContext& before, EGLDisplay own);

struct NamedDisplay
{
    EGLDisplay display;
    std::string name; ///< for messages
};

/// Displays that need no window system, in the order of preference, not yet initialised: Mesa's surfaceless
/// platform, each EGL device, and last the default display.
std::vector<NamedDisplay> windowless_displays(const Egl& egl);

struct ContextWishes
{
    bool debug = false;
};

/// A core 4.5 context that can be current without a surface. Throws Error{no_device} with the reason.
EGLContext create_context(const Egl& egl, EGLDisplay display, const ContextWishes& wishes);

/// "0x3009 (EGL_BAD_MATCH)"
std::string egl_error(const Egl& egl);

} // namespace taut::opengl
