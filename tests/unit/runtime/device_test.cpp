#include "refusal.hpp"
#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/runtime/device.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>
#include <string>

using namespace taut;
using test::refusal;
using test::Refusal;

namespace {

class Environment
{
public:
    Environment(const char* name, const char* value) : name_(name)
    {
        if (const char* old = std::getenv(name))
            old_ = old;
        setenv(name, value, 1);
    }
    ~Environment() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> old_;
};

} // namespace

// ---------------------------------------------------------------- selectors

TEST_CASE("the words of the native executor open it")
{
    for (const char* selector : {"cpu", "cpu:serial", "cpu:shuffled"})
    {
        const auto device = Device::open(selector);
        CHECK(device->info().executor == selector);
        CHECK(device->info().selector == selector);
        CHECK_FALSE(device->info().hardware_gpu);
        CHECK_FALSE(device->info().name.empty());
        CHECK(device->limits().float64);
    }
    CHECK(Device::open("CPU:Serial")->info().executor == "cpu:serial");
}

TEST_CASE("an empty selector takes TAUT_DEVICE")
{
    const Environment set("TAUT_DEVICE", "cpu:shuffled");
    CHECK(Device::open()->info().executor == "cpu:shuffled");
    CHECK(Device::open("cpu:serial")->info().executor == "cpu:serial");
    const Environment wrong("TAUT_DEVICE", "abacus");
    CHECK(refusal([] { Device::open(); }).says("abacus"));
}

TEST_CASE("auto takes a hardware GPU if there is one, else the native CPU on all cores")
{
    const Environment unset("TAUT_DEVICE", "");
    const auto device = Device::open();
    const DeviceInfo best = Device::list().front();
    CHECK((device->info().hardware_gpu || device->info().executor == "cpu"));
    CHECK(device->info().hardware_gpu == best.hardware_gpu);
    CHECK(Device::open("auto")->info().selector == device->info().selector);
}

TEST_CASE("the list holds the native executor in its three modes, behind hardware and before software GPUs")
{
    const std::vector<DeviceInfo> list = Device::list();
    std::vector<std::string> selectors;
    bool software = false;
    for (const DeviceInfo& info : list)
    {
        selectors.push_back(info.selector);
        CHECK_FALSE((software && info.hardware_gpu));
        software = software || !info.hardware_gpu;
        CHECK(info.limits.max_buffer_bytes > 0);
        CHECK(info.limits.max_group_size >= 64);
    }
    for (const char* selector : {"cpu", "cpu:serial", "cpu:shuffled"})
        CHECK(std::count(selectors.begin(), selectors.end(), selector) == 1);
}

TEST_CASE("a fragment of a name opens the first device that has it, whatever the case")
{
    const DeviceInfo cpu = Device::open("cpu")->info();
    std::string fragment = cpu.name.substr(0, 8);
    for (char& c : fragment)
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    CHECK(Device::open(fragment)->info().name.substr(0, 8) == cpu.name.substr(0, 8));
}

TEST_CASE("a device that is not there is refused with the list of what there is")
{
    for (const char* selector : {"abacus", "vulkan:", "vulkan:9999", "vulkan:one", "cpu:fast", "vulkan:-1"})
    {
        const Refusal no = refusal([&] { Device::open(selector); });
        CAPTURE(selector, no.text);
        CHECK(no.code == ErrorCode::no_device);
        CHECK(no.says("there is: "));
        CHECK(no.says("cpu:serial ("));
    }
}

TEST_CASE("every listed device opens by its selector")
{
    for (const DeviceInfo& info : Device::list())
    {
        CAPTURE(info.selector, info.name);
        const auto device = Device::open(info.selector);
        CHECK(device->info().name == info.name);
        CHECK(device->info().selector == info.selector);
    }
}

// ---------------------------------------------------------------- every executor

TEST_CASE("every test device opens, answers to its name and copies bytes there and back")
{
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        const auto device = test_device(selector);
        CHECK(test_device(selector) == device);
        const BufferPtr buffer = device->make_buffer(1000, "copy");
        CHECK(buffer->bytes() == 1000);
        CHECK(device->read<std::uint8_t>(buffer, 1000) == std::vector<std::uint8_t>(1000, 0));
        const std::vector<std::uint32_t> values = {1, 2, 3, 0xdeadbeef};
        device->write<std::uint32_t>(buffer, values, 400);
        CHECK(device->read<std::uint32_t>(buffer, 4, 400) == values);
        CHECK(device->read<std::uint32_t>(buffer, 1, 396)[0] == 0);
    }
}
