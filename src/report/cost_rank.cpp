// Which settings are worth their price, and the answer in words.
#include "taut/report/cost.hpp"

#include <algorithm>
#include <charconv>

namespace taut {
namespace {

/// Three digits, whatever the locale.
std::string number(double value)
{
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 3).ptr;
    return std::string(text, end);
}

/// What counts for ranking: nothing is told apart below ten times the reference's own error.
double ranked_error(const CostPoint& point, double floor) { return std::max(*point.error, floor); }

bool beats(const CostPoint& a, const CostPoint& b, double floor)
{
    const double ea = ranked_error(a, floor), eb = ranked_error(b, floor);
    return ea <= eb && a.ms <= b.ms && (ea < eb || a.ms < b.ms);
}

const CostPoint* most_accurate(const CostStudy& study)
{
    const CostPoint* best = nullptr;
    for (const CostPoint& point : study.points)
        if (point.error && (!best || *point.error < *best->error))
            best = &point;
    return best;
}

std::string result_text(const CostPoint& point, const std::string& metric)
{
    return setting_text(point) + ", " + number(point.ms) + " ms per simulated second (" + metric + " " +
           number(100 * *point.error) + " %)";
}

} // namespace

void rank(CostStudy& study)
{
    const double own = study.reference.error.value_or(0), floor = 10 * own;
    for (CostPoint& point : study.points)
    {
        point.at_floor = point.error && *point.error < floor;
        point.pareto = point.error &&
                       std::none_of(study.points.begin(), study.points.end(), [&](const CostPoint& other) {
                           return other.error && beats(other, point, floor);
                       });
    }
    study.targets.clear();
    for (const double tolerance : {0.1, 0.01, 0.001})
    {
        CostTarget target{tolerance, std::nullopt};
        for (std::size_t i = 0; i < study.points.size(); ++i)
        {
            const CostPoint& point = study.points[i];
            const bool reached = point.error && *point.error + own <= tolerance;
            if (reached && (!target.cheapest || point.ms < study.points[*target.cheapest].ms))
                target.cheapest = i;
        }
        study.targets.push_back(target);
    }
}

std::string setting_text(const CostPoint& point)
{
    const auto count = [](std::uint32_t n, const char* what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    return count(point.substeps, "substep") + " x " + count(point.iterations, "iteration") + " in " +
           std::string(to_string(point.precision));
}

std::vector<std::string> cost_sentences(const CostStudy& study)
{
    std::vector<std::string> out;
    const CostPoint* best = most_accurate(study);
    for (const CostTarget& target : study.targets)
    {
        const std::string percent = number(100 * target.tolerance) + " %";
        if (target.cheapest)
            out.push_back(percent + ": " + result_text(study.points[*target.cheapest], study.metric) + ".");
        else if (best)
            out.push_back(percent + " is not reached; the best is " + result_text(*best, study.metric) + ".");
        else
            out.push_back(percent + " is not reached; no setting has an error.");
    }
    return out;
}

} // namespace taut
