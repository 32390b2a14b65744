#pragma once
// Labels of a plot that stand on nothing else. Internal to svg_plot.cpp.

#include "taut/report/svg_text.hpp"

#include <algorithm>
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

class Labels
{
public:
    explicit Labels(const AreaBox& area) : area_(area) {}

    /// A mark that no label may cover.
    void keep_off(double x, double y, double half)
    {
        taken_.push_back({x - half, y - half, x + half, y + half});
    }

    /// Tries right and left of a point, at its height, above and below, then further off; gives up else. A
    /// label that starts at the right edge of the area stands outside it.
    void add(double x, double y, const std::string& words, const char* fill)
    {
        constexpr double kChar = 5.4, kHeight = 10; // of text of size 10
        const double width = kChar * static_cast<double>(words.size());
        const bool outside = x > area_.right;
        const bool right_first = x < area_.left + 0.8 * (area_.right - area_.left) || outside;
        for (const double dy : {-8.0, 16.0, 4.0, -20.0, 28.0, -32.0, 40.0})
            for (const bool right : {right_first, !right_first})
            {
                const double from = outside ? x - 4 - width : right ? x + 9 : x - 9 - width;
                const double base = y + (outside ? dy + 1 : dy);
                const AreaBox box{from, base - kHeight + 2, from + width, base + 2};
                if (!inside(box) || std::any_of(taken_.begin(), taken_.end(),
                                                [&](const AreaBox& other) { return other.meets(box); }))
                    continue;
                taken_.push_back(box);
                text_ += text(from, base, words, {.size = 10, .anchor = "start", .fill = fill, .halo = true});
                return;
            }
    }
    const std::string& svg() const { return text_; }

private:
    bool inside(const AreaBox& box) const
    {
        return box.left > area_.left && box.right <= area_.right + 1 && box.top > area_.top &&
               box.bottom < area_.bottom;
    }

    AreaBox area_;
    std::vector<AreaBox> taken_;
    std::string text_;
};

} // namespace taut::svg_text
