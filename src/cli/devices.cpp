// taut devices: every device that --device could name, best first.

#include "taut/cli/command.hpp"
#include "taut/cli/output.hpp"
#include "taut/runtime/device.hpp"
#include "taut/version.hpp"

#include <iostream>

namespace taut::cli {
namespace {

Json to_json(const DeviceInfo& device)
{
    const DeviceLimits& limits = device.limits;
    return {{"selector", device.selector},
            {"executor", device.executor},
            {"name", device.name},
            {"driver", device.driver},
            {"hardware_gpu", device.hardware_gpu},
            {"limits",
             {{"max_buffer_bytes", limits.max_buffer_bytes},
              {"offset_alignment", limits.offset_alignment},
              {"max_groups_per_dimension", limits.max_groups_per_dimension},
              {"max_group_size", limits.max_group_size},
              {"max_shared_bytes", limits.max_shared_bytes},
              {"max_param_bytes", limits.max_param_bytes},
              {"max_bindings", limits.max_bindings},
              {"float64", limits.float64}}}};
}

int devices(bool json)
{
    const std::vector<DeviceInfo> list = Device::list();
    if (json)
    {
        Json all = Json::array();
        for (const DeviceInfo& device : list)
            all.push_back(to_json(device));
        std::cout << to_text({{"taut", TAUT_VERSION}, {"devices", all}});
        return kDone;
    }
    std::vector<std::vector<std::string>> rows = {{"selector", "buffer", "shared", "double", "GPU", "name"}};
    for (const DeviceInfo& device : list)
        rows.push_back({device.selector, bytes_text(device.limits.max_buffer_bytes),
                        bytes_text(device.limits.max_shared_bytes), device.limits.float64 ? "yes" : "no",
                        device.hardware_gpu ? "yes" : "no", device.name + " (" + device.driver + ")"});
    std::cout << table(rows);
    return kDone;
}

} // namespace

void add_devices(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("devices", "List the devices that --device can name");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print one JSON object");
    command->callback([&chosen, json] { chosen = [json] { return devices(*json); }; });
}

} // namespace taut::cli
