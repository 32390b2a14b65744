#include "taut/report/svg_area.hpp"

#include <algorithm>
#include <limits>

namespace taut::svg_text {

Area::Area(const Plot& plot) : linear(plot.x_linear), most(plot.y_most)
{
    constexpr double kFar = 1e-2; // a floor below this part of the lowest point would only squeeze the points
    double low[2], high[2];
    std::fill(low, low + 2, std::numeric_limits<double>::infinity());
    std::fill(high, high + 2, -std::numeric_limits<double>::infinity());
    for (const PlotSeries& series : plot.series)
        for (const PlotPoint& p : series.points)
            for (int k = 0; k < 2; ++k)
                if (drawable(p, linear) && (k == 0 || p.y <= most))
                {
                    low[k] = std::min(low[k], k == 0 ? p.x : p.y);
                    high[k] = std::max(high[k], k == 0 ? p.x : p.y);
                }
    for (const PlotFloor& floor : plot.floors)
        if (floor.y > 0 && floor.y < low[1] && (floor.always || floor.y > kFar * low[1]))
            low[1] = floor.y;
    x = axis_of(low[0], high[0], linear, kLeft, kLeft + kWide);
    y = axis_of(low[1], high[1], false, kTop + kHigh, kTop);
}

} // namespace taut::svg_text
