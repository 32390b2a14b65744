#pragma once
// The OpenGL 4.5 executor, seen from outside. No GL or EGL header is needed to include this.

#include "taut/runtime/device.hpp"

#include <memory>
#include <vector>

namespace taut {

/// The device that open_opengl would give: once as "opengl" (GLSL text) and, where the driver takes
/// SPIR-V, once more as "opengl:spirv". Empty where there is no libEGL, driver or OpenGL 4.5.
std::vector<DeviceInfo> list_opengl();

/// Opens a context of its own without a window. Every call makes that context current and gives the
/// thread back what was current before. `spirv`: kernels go to the driver as SPIR-V, not as text.
/// Throws Error{no_device} with the reason, Error{unsupported} for SPIR-V that the driver cannot take.
std::shared_ptr<Device> open_opengl(bool spirv, const OpenOptions& options);

} // namespace taut
