#include "support/devices.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <thread>

namespace taut {

std::shared_ptr<Device> test_device(const std::string& selector)
{
    // Never destroyed: graphics drivers are gone by the time static objects of a program end.
    static auto& opened = *new std::map<std::string, std::shared_ptr<Device>>;
    std::shared_ptr<Device>& device = opened[selector];
    if (!device)
        device = open_test_device(selector);
    return device;
}

std::shared_ptr<Device> open_test_device(const std::string& selector)
{
    OpenOptions options;
    options.validation = selector.starts_with("vulkan");
    options.threads = std::max(2u, std::thread::hardware_concurrency());
    return Device::open(selector, options);
}

bool environment_has(const char* variable)
{
    const char* value = std::getenv(variable);
    return value && *value && std::string(value) != "0";
}

namespace {

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();)
    {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        if (end > begin)
            words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// Whether it opens; says so once if it does not.
bool opens(const std::string& selector)
{
    try
    {
        test_device(selector);
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::no_device || environment_has("TAUT_REQUIRE_DEVICE"))
            throw;
        left_out(selector + ": " + error.what());
        return false;
    }
}

std::vector<std::string> find_devices()
{
    const char* chosen = std::getenv("TAUT_TEST_DEVICES");
    if (chosen && *chosen)
        return split(chosen); // named by a person: a missing one fails when it is opened
    std::vector<std::string> selectors = {"cpu:serial", "cpu"};
    if (environment_has("TAUT_TEST_SHORT"))
        return selectors;
    selectors.emplace_back("cpu:shuffled");
    std::vector<const char*> drivers = {"vulkan", "opengl"};
    if (!environment_has("TAUT_TEST_WITHOUT_SPIRV"))
        drivers.push_back("opengl:spirv");
    for (const char* selector : drivers)
        if (opens(selector))
            selectors.push_back(selector);
    return selectors;
}

} // namespace

const std::vector<std::string>& test_devices()
{
    static const std::vector<std::string> selectors = find_devices();
    return selectors;
}

} // namespace taut
