#pragma once
// The option --device, and how the program opens what it names.

#include "taut/cli/command.hpp"
#include "taut/runtime/device.hpp"

#include <memory>
#include <string>

namespace taut::cli {

/// Adds --device to a command; `further` names what it takes beside the devices.
void add_device_option(CLI::App& command, std::string& selector, const std::string& further = {});

/// Adds --device-costs to a command that plans: what the plan weighs instead of measured costs.
void add_costs_option(CLI::App& command);

/// Opens with the program's pipeline cache: the file that TAUT_PIPELINE_CACHE names ("off": none), else
/// taut/pipelines.bin under XDG_CACHE_HOME or ~/.cache; and with the costs that plans weigh in
/// TAUT_DEVICE_COSTS ("off": measured in every run), else taut/costs.txt there. Throws Error{no_device}, and
/// Error{io} or Error{bad_input} where another file stands at one of these places: it is left as it is.
std::shared_ptr<Device> open_device(const std::string& selector);

} // namespace taut::cli
