#pragma once
// How the series of a plot look, and their lines and markers. Internal to svg_plot.cpp.

#include "taut/report/svg_area.hpp"
#include "taut/report/svg_labels.hpp"

#include <cstddef>
#include <string>

namespace taut::svg_text {

/// How a series looks: the same in its line, its markers and the legend.
struct Look
{
    Look(const PlotSeries& series, std::size_t index);

    /// Attributes of its line.
    std::string dashes() const;
    std::string mark(double x, double y, double size) const;

    std::size_t shape;
    std::string colour;
    std::size_t variant;
};

/// `labels` keeps off what is drawn.
std::string draw_series(const PlotSeries& series, std::size_t index, const Area& area, Labels& labels);

} // namespace taut::svg_text
