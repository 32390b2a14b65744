#pragma once
// A kernel against its reference on every executor.

#include "conformance/tolerances.hpp"
#include "support/devices.hpp"
#include "support/kernel_run.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#ifndef TAUT_HOST
#define TAUT_HOST
#endif
#include "taut/kernels/shared/layouts.h"

namespace taut::conformance {

/// What a buffer must hold: value by value, with the size of the terms that made each value. Scale 0: exactly
/// this value. Infinite scale: any finite value. A value that is NaN must be NaN.
struct Field
{
    std::vector<double> value, scale;

    void add(double v, double s)
    {
        value.push_back(v);
        scale.push_back(s);
    }
};

using Events = std::array<std::uint32_t, TAUT_EVENT_COUNT>;
inline constexpr double kAnyFinite = std::numeric_limits<double>::infinity();

template <typename Real>
constexpr Precision precision_of()
{
    return sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
}

/// The values of a buffer of reals, records or vectors of reals, as double (exact).
template <typename Real>
std::vector<double> reals_of(const Bytes& bytes)
{
    const std::vector<Real> values = values_of<Real>(bytes);
    return {values.begin(), values.end()};
}

/// Launches, their input and what must come out.
struct Case
{
    Precision precision = Precision::float32;
    Buffers in;
    std::vector<Launch> launches;
    std::map<std::string, Field> expected; ///< buffers of reals
    Events events = {};                    ///< checked when the launches bind "events"
    double slack = 1;                      ///< several launches in a row: their errors add up
};

inline Bytes no_events() { return bytes_of(std::vector<std::uint32_t>(TAUT_EVENT_COUNT, 0u)); }

/// The first value that is too far from the field, as a sentence; empty if there is none.
inline std::string first_difference(const Field& field, const std::vector<double>& actual, double unit)
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

/// Compares one run with the reference.
inline void check_against_reference(const Case& c, const Buffers& out)
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

/// Buffers that differ in any bit, by name; empty if none.
inline std::string differing_buffers(const Buffers& a, const Buffers& b)
{
    std::string names;
    for (const auto& [name, bytes] : a)
        if (bytes != b.at(name))
            names += (names.empty() ? "" : ", ") + name;
    return names;
}

inline bool can_run(const Device& device, Precision precision)
{
    return precision == Precision::float32 || device.limits().float64;
}

/// Runs on every executor; each result must agree with the reference, and bit for bit with cpu:serial where
/// that is promised. No validation message may appear. `look`, if any, sees what each executor left.
/// `bitwise`: false where NaN may come out, whose bits nobody promises.
inline void look_on_every_device(const Case& c, const std::function<void(const Buffers&)>& look,
                                 bool bitwise = true)
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

inline void check_on_every_device(const Case& c) { look_on_every_device(c, nullptr); }

} // namespace taut::conformance
