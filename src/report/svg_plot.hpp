#pragma once
// Log-log plots as SVG text: work-precision diagrams (error against cost), and errors over time on a linear
// axis. Values in, text out; the same values give the same bytes on every machine.

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace taut {

struct PlotPoint
{
    double x = 0, y = 0;  ///< in the units of the axes
    std::string label;    ///< what made it, e.g. "10 substeps x 1"; written at points of the front
    double floor = 0;     ///< values of y below it count as equal on the front
    double x_low = 0, x_high = 0; ///< spread of x, drawn as a bar where 0 < low < high
};

struct PlotSeries
{
    std::string name;              ///< in the legend
    std::vector<PlotPoint> points; ///< joined in this order; one that is not finite and positive breaks the
                                   ///< line and joins the gaps
    bool own_front = false; ///< only those that no other of the series beats are joined, by a bold line
    std::string note = {};  ///< written below its lowest point
    /// Colour and marker: 0 to 6, the same in every plot; < 0: by its place in this one.
    int style = -1;
    int variant = 0; ///< of those that share a style: dashes and the marker's filling tell them apart, from
                     ///< the fourth on also another marker
};

/// Below it values of y say nothing: shaded, with a line and its words.
struct PlotFloor
{
    double y = 0;
    std::string words;
    bool of_all = true;  ///< shaded below; else of some points alone, a line
    bool always = false; ///< drawn however far below all points it lies
};

struct Plot
{
    std::string title;
    std::string x_label, y_label;     ///< with their units
    std::vector<PlotSeries> series;
    bool front = true;                ///< mark the points that no other beats in both x and y
    bool x_linear = false;            ///< x may then be any finite number
    /// Points above this in y do not stretch the axis: they stand at its upper edge and are listed by number.
    double y_most = std::numeric_limits<double>::infinity();
    std::vector<std::string> caption; ///< below the plot: reference class, machine, settings
    std::vector<std::string> gaps;    ///< "name: reason" of what has no point: gap_table(), not drawn
    std::vector<PlotFloor> floors = {};
};

/// Appends the series as one more variant of its style.
void add_variant(Plot& plot, PlotSeries series);

/// Whether a point has a place on the axes.
bool drawable(const PlotPoint& point, bool x_linear = false);

/// The gaps, and points of series that are not drawable: "name: reason".
std::vector<std::string> all_gaps(const Plot& plot);
/// The same as a table of Markdown. Empty when there is none.
std::string gap_table(const Plot& plot);

/// Of all points of all series: series and point index of those that no other point beats (smaller or
/// equal in both, smaller in one), by ascending x. Points that are not finite and positive never count.
struct FrontPoint
{
    std::size_t series = 0, point = 0;
};
std::vector<FrontPoint> pareto_front(const std::vector<PlotSeries>& series);

/// A bound for Plot::y_most: ten times the largest y that is at most `useful`; infinite where there is none.
double off_the_top(const std::vector<PlotSeries>& series, double useful);

/// A whole SVG document. Joined series of more than 50 points have markers at some of them.
std::string svg(const Plot& plot);

/// Written to a temporary name, then renamed. Throws Error{io}.
void write_svg(const std::filesystem::path& file, const Plot& plot);

} // namespace taut
