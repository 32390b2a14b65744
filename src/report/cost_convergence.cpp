// How the error of each method falls with more substeps, and with more iterations.
#include "taut/report/cost.hpp"
#include "taut/report/method_settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

namespace taut {
namespace {

std::string two_decimals(double value)
{
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 2).ptr;
    return std::string(text, end);
}

std::uint32_t varied(const CostPoint& point, CostSplit split)
{
    return split == CostSplit::substeps ? point.substeps : point.iterations;
}

std::uint32_t fixed_count(const CostPoint& point, CostSplit split)
{
    return split == CostSplit::substeps ? point.iterations : point.substeps;
}

std::string family(const CostStudy& study, const CostPoint& point)
{
    std::string name = point.method;
    if (const std::string details = settings_details(point.settings); !details.empty())
        name += ", " + details;
    const bool mixed = std::any_of(study.points.begin(), study.points.end(), [&](const CostPoint& other) {
        return other.precision != study.points[0].precision;
    });
    return mixed ? name + ", " + std::string(to_string(point.precision)) : name;
}

/// Of each fixed count how many points vary beside it; the longest row counts, of equal ones the one with
/// fewer iterations or more substeps.
std::uint32_t longest_row(const std::vector<const CostPoint*>& points, CostSplit split)
{
    std::map<std::uint32_t, std::set<std::uint32_t>> rows;
    for (const CostPoint* point : points)
        rows[fixed_count(*point, split)].insert(varied(*point, split));
    auto best = rows.begin();
    for (auto row = rows.begin(); row != rows.end(); ++row)
    {
        const bool longer = row->second.size() > best->second.size();
        if (longer || (row->second.size() == best->second.size() && split == CostSplit::iterations))
            best = row;
    }
    return best->first;
}

constexpr double kFlat = 0.1; ///< a slope below it says that an error has come to its floor

void observe(CostOrder& row, double floor)
{
    std::vector<double> slopes;
    for (std::size_t i = 1; i < row.points.size(); ++i)
    {
        const PlotPoint &a = row.points[i - 1], &b = row.points[i];
        const bool told = b.y > floor && a.y < 0.5 && a.y > 0;
        if (told)
            slopes.push_back(std::log(a.y / b.y) / std::log(b.x / a.x));
    }
    for (; !slopes.empty() && !(slopes.back() >= kFlat); slopes.pop_back())
        row.at_floor = true;
    if (slopes.empty())
        return;
    const double before = slopes.size() > 1 ? slopes[slopes.size() - 2] : slopes.back();
    row.order = 0.5 * (before + slopes.back());
    if (!(*row.order >= kFlat)) // it went up on the way
        row.order.reset();
}

/// "xpbd 1.98, then at its floor"
std::string order_text(const CostOrder& row)
{
    if (!row.order)
        return row.name + (row.at_floor ? " at its floor" : " none");
    return row.name + " " + two_decimals(*row.order) + (row.at_floor ? ", then at its floor" : "");
}

} // namespace

std::vector<CostOrder> convergence(const CostStudy& study, CostSplit split)
{
    std::vector<std::pair<std::string, std::vector<const CostPoint*>>> families;
    for (const CostPoint& point : study.points)
    {
        if (split == CostSplit::iterations && !reads_iterations(method_named(point.method)))
            continue;
        const std::string name = family(study, point);
        auto found =
            std::find_if(families.begin(), families.end(), [&](const auto& f) { return f.first == name; });
        if (found == families.end())
            found = families.insert(found, {name, {}});
        found->second.push_back(&point);
    }
    std::vector<CostOrder> out;
    for (auto& [name, points] : families)
    {
        CostOrder row{name, points[0]->method, longest_row(points, split), {}, {}, false};
        std::sort(points.begin(), points.end(), [&](const CostPoint* a, const CostPoint* b) {
            return varied(*a, split) < varied(*b, split);
        });
        for (const CostPoint* point : points)
            if (point->error && fixed_count(*point, split) == row.fixed)
                row.points.push_back({static_cast<double>(varied(*point, split)), *point->error, "", 0});
        if (row.points.size() < 2)
            continue;
        observe(row, 10 * study.reference.error.value_or(0));
        out.push_back(std::move(row));
    }
    return out;
}

Plot convergence_plot(const CostStudy& study, CostSplit split)
{
    const bool substeps = split == CostSplit::substeps;
    Plot plot;
    plot.title = "Error against " + std::string(substeps ? "substeps: " : "iterations: ") + study.scene;
    plot.x_label = substeps ? "substeps of a time step" : "iterations of a substep";
    plot.y_label = "error " + study.metric;
    plot.front = false;
    std::string orders;
    for (const CostOrder& row : convergence(study, split))
    {
        const std::string fixed =
            std::to_string(row.fixed) + (substeps ? " iteration" : " substep") + (row.fixed == 1 ? "" : "s");
        add_variant(plot, {row.name + " (" + fixed + ")", row.points, false,
                           row.at_floor ? "at its floor" : "", method_style(method_named(row.method))});
        orders += (orders.empty() ? "" : "; ") + order_text(row);
    }
    plot.y_most = off_the_top(plot.series, 1);
    plot.floors = plot_floors(study);
    plot.caption.push_back("Reference class " + study.reference.name + ". " + study.reference.text);
    plot.caption.push_back(
        orders.empty() ? "No method has two settings that differ in their " +
                             std::string(substeps ? "substeps" : "iterations") + " alone."
                       : "Observed order, mean of the last two slopes between errors below 50 % and above the"
                         " reference's floor: " +
                             orders + ".");
    return plot;
}

} // namespace taut
