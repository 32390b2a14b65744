#pragma once
// What AMD's compiler in Mesa (RADV with ACO) makes of the kernels, for GPUs that are not here:
// RADV_FORCE_FAMILY gives a device without memory and without queues that run, on which pipelines can be
// created all the same.
//
// Based on: VK_KHR_pipeline_executable_properties; Mesa 22.3, "Environment variables", RADV_FORCE_FAMILY.
// Departures: none. Mesa 26.1 has the variable no more ("has been removed. Please use AMDGPU drm-shim now"),
// and Debian has no package of that shim: there the test says that it is left out.

#include "hardware/table.hpp"

#include "taut/runtime/base/kernel_info.hpp"

#include <string>
#include <vector>

namespace taut::hardware {

/// The families of the table, one a generation: GCN 4, GCN 5, RDNA 2.
inline constexpr const char* kFamilies[] = {"polaris10", "vega10", "navi21"};

/// The driver's file for the Vulkan loader, from TAUT_RADV_DRIVER or the folders of the system; empty if
/// there is none.
std::string radv_driver_file();

/// What one family's compiler made of every kernel.
struct Compiled
{
    std::string device;              ///< as the driver names it
    std::string mesa;                ///< "Mesa 22.3.6"
    std::vector<Row> rows;           ///< in the order of all_kernels()
    std::vector<std::string> failed; ///< kernels that did not compile, with the reason
};

/// Compiles every kernel of the library through vulkan::Pipelines, as the Vulkan executor does. Sets
/// environment variables of this process (family, driver, no cache of shaders): call from one thread. Throws
/// Error{no_device} where the driver gives no such device.
Compiled compile_all(const std::string& family, const std::string& driver_file);

} // namespace taut::hardware
