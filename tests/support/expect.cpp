#include "support/expect.hpp"

#include "conformance/tolerances.hpp"

#include <cmath>
#include <sstream>

namespace taut::conformance {

std::string first_difference(const Field& field, const std::vector<double>& actual, double unit)
{
    if (field.value.size() != actual.size())
        return "expected " + std::to_string(field.value.size()) + " values, got " +
               std::to_string(actual.size());
    for (std::size_t i = 0; i < actual.size(); ++i)
    {
        const double want = field.value[i], have = actual[i], scale = field.scale[i];
        const bool both_nan = std::isnan(want) && std::isnan(have);
        const bool good = scale == kAnyFinite      ? std::isfinite(have)
                          : both_nan || scale == 0 ? both_nan || want == have
                                                   : std::abs(want - have) <= unit * scale;
        if (good)
            continue;
        std::ostringstream text;
        text.precision(17);
        text << "value " << i << " is " << have << ", the reference says " << want << "; apart "
             << std::abs(want - have) / (unit * scale) << " times what is allowed";
        return text.str();
    }
    return {};
}

void check_against_reference(const Case& c, const Buffers& out)
{
    const std::string_view kernel = c.launches.front().kernel->name;
    const double eps = c.precision == Precision::float64 ? 0x1p-52 : 0x1p-23;
    const double unit = tolerance_of(kernel) * eps * c.slack;
    for (const auto& [name, field] : c.expected)
    {
        const Bytes& bytes = out.at(name);
        const auto actual =
            c.precision == Precision::float64 ? reals_of<double>(bytes) : reals_of<float>(bytes);
        const std::string difference = first_difference(field, actual, unit);
        INFO("buffer " << name);
        CHECK(difference == "");
    }
    if (out.count("events"))
    {
        const auto events = values_of<std::uint32_t>(out.at("events"));
        CHECK(events == std::vector<std::uint32_t>(c.events.begin(), c.events.end()));
    }
}

std::string differing_buffers(const Buffers& a, const Buffers& b)
{
    std::string names;
    for (const auto& [name, bytes] : a)
        if (bytes != b.at(name))
            names += (names.empty() ? "" : ", ") + name;
    return names;
}

bool can_run(const Device& device, Precision precision)
{
    return precision == Precision::float32 || device.limits().float64;
}

void look_on_every_device(const Case& c, const std::function<void(const Buffers&)>& look,
                                 bool bitwise)
{
    const Buffers serial = run(*test_device("cpu:serial"), c.launches, c.in);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, c.precision))
            continue;
        const KernelInfo& kernel = *c.launches.front().kernel;
        INFO(selector << ": " << kernel.name << " \"" << kernel.variant << "\" "
                      << to_string(kernel.precision));
        const Buffers out = run(*device, c.launches, c.in);
        check_against_reference(c, out);
        if (look)
            look(out);
        if (bitwise && bitwise_equal_expected(device->info()))
            CHECK(differing_buffers(serial, out) == "");
        CHECK(device->counters().validation_messages == 0);
    }
}

} // namespace taut::conformance
