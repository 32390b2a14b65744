#include "taut/report/svg_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut::svg_text {
namespace {

// Of text: its size, a character, what is below its line, and from line to line.
constexpr double kLabelSize = 10, kLabelChar = 5.4, kLabelFoot = 2, kLabelLead = 11;

/// Of lines of words that begin at a place, the last one on `base`.
AreaBox label_box(double from, double base, const std::vector<std::string>& lines)
{
    std::size_t longest = 0;
    for (const std::string& words : lines)
        longest = std::max(longest, words.size());
    const double top = base + kLabelFoot - kLabelSize - kLabelLead * static_cast<double>(lines.size() - 1);
    return {from, top, from + kLabelChar * static_cast<double>(longest), base + kLabelFoot};
}

std::ptrdiff_t label_meetings(const AreaBox& box, const std::vector<AreaBox>& others)
{
    return std::count_if(others.begin(), others.end(),
                         [&](const AreaBox& other) { return other.meets(box); });
}

} // namespace

void Labels::keep_off(double x, double y, double half)
{
    taken_.push_back({x - half, y - half, x + half, y + half});
}

void Labels::keep_off(const Path& path)
{
    constexpr double kStep = 3, kHalf = 1; // pixels
    for (std::size_t i = 1; i < path.size(); ++i)
    {
        const auto [x, y] = path[i - 1];
        const double dx = path[i].first - x, dy = path[i].second - y;
        const double steps = std::max(std::ceil(std::max(std::abs(dx), std::abs(dy)) / kStep), 1.0);
        for (double k = 0; k <= steps; ++k)
        {
            const double px = x + dx * k / steps, py = y + dy * k / steps;
            lines_.push_back({px - kHalf, py - kHalf, px + kHalf, py + kHalf});
        }
    }
}

void Labels::add(double x, double y, const std::string& words, const char* fill)
{
    constexpr double kHeights[] = {-8, 16, 4, -20, 28, -32, 40};
    constexpr double kNear = 16; // no label goes further to keep off a line
    const double width = kLabelChar * static_cast<double>(words.size());
    const bool right_first = x < area_.left + 0.8 * (area_.right - area_.left);
    for (const bool off_lines : {true, false})
        for (const double dy : kHeights)
            for (const bool right : {right_first, !right_first})
            {
                const AreaBox box = label_box(right ? x + 9 : x - 9 - width, y + dy, {words});
                if (!inside(box) || label_meetings(box, taken_) > 0)
                    continue;
                if (off_lines && (std::abs(dy) > kNear || label_meetings(box, lines_) > 0))
                    continue;
                return place(box, {words}, fill);
            }
}

void Labels::add_along(double y, const std::string& words, const char* fill)
{
    constexpr double kStep = 8, kEnd = 4, kGap = 3; // pixels
    const std::vector<std::string> whole{words};
    AreaBox best{};
    auto least = std::numeric_limits<std::ptrdiff_t>::max();
    for (const std::vector<std::string>& lines : {whole, wrapped(words, words.size() * 2 / 3)})
    {
        const AreaBox size = label_box(0, 0, lines);
        const double above = y - kGap, below = y + kGap - size.top;
        for (double from = area_.right - kEnd - size.right; from > area_.left; from -= kStep)
            for (const double base : {above, below})
            {
                const AreaBox box = label_box(from, base, lines);
                if (!inside(box))
                    continue;
                const std::ptrdiff_t covered = label_meetings(box, taken_) + label_meetings(box, lines_);
                if (covered == 0)
                    return place(box, lines, fill);
                if (lines.size() == 1 && covered < least)
                {
                    least = covered;
                    best = box;
                }
            }
    }
    if (least < std::numeric_limits<std::ptrdiff_t>::max())
        place(best, whole, fill);
}

bool Labels::inside(const AreaBox& box) const
{
    return box.left > area_.left && box.right <= area_.right + 1 && box.top > area_.top &&
           box.bottom < area_.bottom;
}

void Labels::place(const AreaBox& box, const std::vector<std::string>& lines, const char* fill)
{
    taken_.push_back(box);
    const TextStyle style{.size = kLabelSize, .anchor = "start", .fill = fill};
    double base = box.top + kLabelSize - kLabelFoot;
    for (const std::string& words : lines)
    {
        halos_ += halo(box.left, base, words, style);
        text_ += text(box.left, base, words, style);
        base += kLabelLead;
    }
}

} // namespace taut::svg_text
