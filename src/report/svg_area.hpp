#pragma once
// Where a plot lies on its page, and both its axes. Internal to svg_plot.cpp.

#include "taut/report/svg_axis.hpp"
#include "taut/report/svg_plot.hpp"

namespace taut::svg_text {

inline constexpr double kLeft = 84, kTop = 56, kWide = 560, kHigh = 400; ///< the plot area, pixels

/// Both axes of a plot.
struct Area
{
    explicit Area(const Plot& plot);

    bool holds(const PlotPoint& p) const { return drawable(p, linear) && p.y <= most; }
    bool above(const PlotPoint& p) const { return drawable(p, linear) && p.y > most; }

    bool linear;
    double most;
    Axis x, y;
};

} // namespace taut::svg_text
