#include "taut/report/svg_axis.hpp"

#include "taut/report/svg_text.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>

namespace taut::svg_text {
namespace {

/// The least of 1, 2 and 5 times a power of ten that takes at most ten steps for a span.
double round_step(double span)
{
    const double power = std::pow(10.0, std::floor(std::log10(span / 10)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power * 10 >= span)
            return factor * power;
    return 10 * power;
}

} // namespace

double Axis::at(double value) const
{
    const double place = linear ? value : std::log10(value);
    return from + (place - first) / (last - first) * (to - from);
}

std::vector<Axis::Tick> Axis::ticks() const
{
    std::vector<Tick> out;
    const auto pixel = [&](double place) { return from + (place - first) / (last - first) * (to - from); };
    if (linear)
    {
        const auto count = static_cast<int>(std::lround((last - first) / step));
        for (int k = 0; k <= count; ++k)
            out.push_back({pixel(first + k * step), first + k * step});
        return out;
    }
    const int low = static_cast<int>(first), high = static_cast<int>(last);
    const int every = std::max(1, (high - low + 9) / 10);
    for (int decade = low; decade <= high; ++decade)
    {
        if (decade < high && high - low <= 6)
            for (int k = 2; k < 10; ++k)
                out.push_back({at(k * std::pow(10.0, decade)), 0, true, false});
        out.push_back({pixel(decade), double(decade), false, (decade - low) % every == 0});
    }
    return out;
}

std::string Axis::label(const Tick& tick, double x, double y, const char* anchor) const
{
    const TextStyle style{.size = 12, .anchor = anchor};
    return linear ? text(x, y, shown(tick.value, 6), style)
                  : power_of_ten(x, y, static_cast<int>(tick.value), style);
}

Axis axis_of(double low, double high, bool linear, double from, double to)
{
    Axis axis{linear, 0, 1, 1, from, to};
    if (!(high >= low))
        return axis;
    if (!linear)
    {
        axis.first = std::floor(std::log10(low));
        axis.last = std::max(axis.first + 1, std::ceil(std::log10(high)));
        return axis;
    }
    axis.step = high > low ? round_step(high - low) : 1;
    axis.first = axis.step * std::floor(low / axis.step);
    axis.last = std::max(axis.first + axis.step, axis.step * std::ceil(high / axis.step));
    return axis;
}

} // namespace taut::svg_text
