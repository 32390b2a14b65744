#pragma once
// A kernel against its reference on every executor.

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
std::string first_difference(const Field& field, const std::vector<double>& actual, double unit);

/// Compares one run with the reference.
void check_against_reference(const Case& c, const Buffers& out);

/// Buffers that differ in any bit, by name; empty if none.
std::string differing_buffers(const Buffers& a, const Buffers& b);

/// The native executors always; software drivers because they round each operation as C++ does.
/// Hardware may fuse products into sums and divide with up to 2.5 units of error: tolerance only.
inline bool bitwise_equal_expected(const DeviceInfo& info) { return !info.hardware_gpu; }

bool can_run(const Device& device, Precision precision);

/// Runs on every executor; each result must agree with the reference, and bit for bit with cpu:serial where
/// that is promised. No validation message may appear. `look`, if any, sees what each executor left.
/// `bitwise`: false where NaN may come out, whose bits nobody promises.
void look_on_every_device(const Case& c, const std::function<void(const Buffers&)>& look,
                          bool bitwise = true);

inline void check_on_every_device(const Case& c) { look_on_every_device(c, nullptr); }

} // namespace taut::conformance
