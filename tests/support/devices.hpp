#pragma once
// The devices that a test goes over. One body of tests runs on every executor:
//
//   const std::string selector = GENERATE(from_range(taut::test_devices()));
//   const auto device = taut::test_device(selector);
//
// TAUT_TEST_DEVICES=cpu,vulkan    takes these instead of all.
// TAUT_TEST_SHORT=1               takes cpu:serial and cpu alone, as ctest does where other suites hold the
//                                 others to the same bits (conformance, golden): a dispatch of a software
//                                 driver takes a hundred times as long.
// TAUT_TEST_WITHOUT_SPIRV=1       leaves opengl:spirv out, as ctest does of conformance: most of that is the
//                                 driver's compiling every variant of every kernel a third time.
// TAUT_REQUIRE_DEVICE=1           makes a missing executor an error; without it, the program says what
//                                 is left out, and why, and ends as skipped (skip.hpp).

#include "support/skip.hpp"

#include "taut/runtime/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace taut {

/// Opened once per process. Vulkan comes with its validation layers, the native executor with at least
/// two threads. Throws what Device::open throws. Call from one thread.
std::shared_ptr<Device> test_device(const std::string& selector);

/// Another one opened likewise: for a test that runs several at once, a thread each.
std::shared_ptr<Device> open_test_device(const std::string& selector);

/// Whether an environment variable is there, not empty and not "0".
bool environment_has(const char* variable);

/// Selectors of every executor that opens here.
const std::vector<std::string>& test_devices();

} // namespace taut
