// Choosing a display, on an EGL library that exists only here: no driver is asked.

#include "support/catch.hpp"

#include "taut/runtime/opengl/egl.hpp"

#include <string_view>

namespace {

using namespace taut;

int token[3]; // addresses of EGL devices, and of the display of the last

EGLBoolean query_devices(EGLint max, void** devices, EGLint* count)
{
    *count = max < 2 ? max : 2;
    for (EGLint i = 0; i < *count; ++i)
        devices[i] = &token[i];
    return EGL_TRUE;
}

opengl::Egl fake_egl()
{
    opengl::Egl egl;
    egl.QueryString = [](EGLDisplay, EGLint) -> const char* {
        return "EGL_EXT_platform_device EGL_MESA_platform_surfaceless";
    };
    egl.GetProcAddress = [](const char* name) -> __eglMustCastToProperFunctionPointerType {
        if (std::string_view(name) != "eglQueryDevicesEXT")
            return nullptr;
        return reinterpret_cast<__eglMustCastToProperFunctionPointerType>(&query_devices);
    };
    // Only the second device gives a display; a driver may refuse the others.
    egl.GetPlatformDisplay = [](EGLenum, void* native, const EGLAttrib*) -> EGLDisplay {
        return native == &token[1] ? &token[2] : EGL_NO_DISPLAY;
    };
    return egl;
}

} // namespace

TEST_CASE("a device that gives no display is left out, it is not mistaken for the default display")
{
    const auto displays = opengl::windowless_displays(fake_egl());
    REQUIRE(displays.size() == 2);
    CHECK(displays[0].display == &token[2]);
    CHECK(displays[0].name == "EGL device 1");
    CHECK(displays[1].display == EGL_NO_DISPLAY);
    CHECK(displays[1].name == "default EGL display");
}
