#pragma once
// Axes of a plot: numbers to pixels, and where their lines and labels stand. Internal to svg_plot.cpp.

#include <string>
#include <vector>

namespace taut::svg_text {

/// Either whole decades of a logarithm, or whole steps of 1, 2 or 5 times a power of ten.
struct Axis
{
    bool linear = false;
    double first = 0, last = 1; ///< exponents of ten; linear: values
    double step = 1;            ///< linear: from one label to the next
    double from = 0, to = 1;    ///< pixels of the two ends

    double at(double value) const;
    /// Where a line of the grid stands, and what it is.
    struct Tick
    {
        double pixel = 0, value = 0; ///< of a logarithmic axis the exponent
        bool minor = false, labelled = true;
    };
    std::vector<Tick> ticks() const;
    /// The label of a tick at a place.
    std::string label(const Tick& tick, double x, double y, const char* anchor) const;
};

/// An axis that holds `low` to `high`; both positive where it is not linear. `high` < `low`: nothing to hold.
Axis axis_of(double low, double high, bool linear, double from, double to);

} // namespace taut::svg_text
