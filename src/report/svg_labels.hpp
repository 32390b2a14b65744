#pragma once
// Labels of a plot that stand on nothing else. Internal to svg_plot.cpp.

#include "taut/report/svg_text.hpp"

#include <string>
#include <vector>

namespace taut::svg_text {

struct AreaBox
{
    double left, top, right, bottom; ///< pixels
    bool meets(const AreaBox& o) const
    {
        return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
    }
};

/// All that labels must keep off is told first, then they are added: those that have few places before those
/// that have many.
class Labels
{
public:
    explicit Labels(const AreaBox& area) : area_(area) {}

    /// A mark that no label may cover.
    void keep_off(double x, double y, double half);
    /// A line that labels cover where they have no other place near.
    void keep_off(const Path& path);

    /// Tries right and left of a point, at its height, above and below, then further off; gives up else.
    void add(double x, double y, const std::string& words, const char* fill);
    /// Tries above and below a line across the area, from its right end to its left one, then the same with
    /// the words in two lines; where no place is free, the one that covers least.
    void add_along(double y, const std::string& words, const char* fill);

    /// The halos of all, then all: no halo covers another label.
    std::string svg() const { return halos_ + text_; }

private:
    bool inside(const AreaBox& box) const;
    void place(const AreaBox& box, const std::vector<std::string>& lines, const char* fill);

    AreaBox area_;
    std::vector<AreaBox> taken_, lines_;
    std::string halos_, text_;
};

} // namespace taut::svg_text
