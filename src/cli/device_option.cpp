#include "taut/cli/device_option.hpp"

#include "taut/cli/numbers.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/world/kept_traits.hpp"

#include <cstdlib>
#include <filesystem>
#include <vector>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

std::string environment(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

/// The file that `variable` names, else `name` in the program's cache folder. Empty when nothing should be
/// kept ("off"), or when there is no place for it, which never stops a run.
std::string kept_file(const char* variable, const char* name)
{
    const std::string chosen = environment(variable);
    if (!chosen.empty())
        return chosen == "off" ? "" : chosen;
    fs::path folder = environment("XDG_CACHE_HOME");
    if (folder.empty() && !environment("HOME").empty())
        folder = fs::path(environment("HOME")) / ".cache";
    if (folder.empty())
        return "";
    folder /= "taut";
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        return "";
    const fs::path file = folder / name;
    return is_free_for_file(file) ? file.string() : "";
}

} // namespace

void add_device_option(CLI::App& command, std::string& selector, const std::string& further)
{
    command.add_option("--device", selector,
                       "auto, vulkan, vulkan:1, part of a name, opengl, opengl:spirv, cpu, cpu:serial" +
                           further + " (default: TAUT_DEVICE, else auto)");
}

void add_costs_option(CLI::App& command)
{
    command
        .add_option_function<std::vector<double>>(
            "--device-costs",
            [](const std::vector<double>& ns) {
                fix_costs(DeviceCosts{ns[0], ns[1], ns[2], ns[3]});
            },
            "What the plan weighs, ns: DISPATCH,BARRIER,ELEMENT,LANE (default: as measured once and kept)")
        ->delimiter(',')
        ->expected(4)
        ->check(number_between(0, 1e12, Ends::open, " (ns)"));
}

std::shared_ptr<Device> open_device(const std::string& selector)
{
    OpenOptions options;
    const std::string wanted = selector.empty() ? environment("TAUT_DEVICE") : selector;
    if (wanted.rfind("cpu", 0) != 0 && wanted.rfind("opengl", 0) != 0)
        options.pipeline_cache = kept_file("TAUT_PIPELINE_CACHE", "pipelines.bin");
    keep_costs_in(kept_file("TAUT_DEVICE_COSTS", "costs.txt"));
    return Device::open(selector, options);
}

} // namespace taut::cli
