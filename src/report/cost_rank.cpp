// Which settings are worth their price, and the answer in words.
#include "taut/report/cost.hpp"

#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>

namespace taut {
namespace {

/// What counts for ranking: nothing is told apart below ten times the reference's own error.
double ranked_error(const CostPoint& point, double floor) { return std::max(*point.error, floor); }

bool beats(const CostPoint& a, const CostPoint& b, double floor, CostBasis basis)
{
    const double ea = ranked_error(a, floor), eb = ranked_error(b, floor);
    const double pa = price(a, basis), pb = price(b, basis);
    return ea <= eb && pa <= pb && (ea < eb || pa < pb);
}

/// The cheapest point whose error is within the tolerance, of one method or (empty) of all; with `own` only
/// of those that have the scene's material.
std::optional<std::size_t> cheapest_of(const CostStudy& study, const std::string& method, double tolerance,
                                       bool own)
{
    const double reference = study.reference.error.value_or(0);
    std::optional<std::size_t> out;
    for (std::size_t i = 0; i < study.points.size(); ++i)
    {
        const CostPoint& point = study.points[i];
        const bool counts =
            (method.empty() || point.method == method) && (!own || point.other_material.empty());
        const bool reached = counts && point.error && *point.error + reference <= tolerance;
        if (reached && (!out || price(point, study.basis) < price(study.points[*out], study.basis)))
            out = i;
    }
    return out;
}

/// The cheapest points for 10 %, 1 % and 0.1 %, of one method or (empty) of all.
std::vector<CostTarget> targets_of(const CostStudy& study, const std::string& method)
{
    std::vector<CostTarget> out;
    for (const double tolerance : {0.1, 0.01, 0.001})
        out.push_back({tolerance, cheapest_of(study, method, tolerance, false),
                       cheapest_of(study, method, tolerance, true)});
    return out;
}

/// Why a method refused all of its settings; empty when it did not.
std::string refusal(const CostStudy& study, const std::string& method)
{
    std::string first;
    for (const CostPoint& point : study.points)
    {
        if (point.method != method)
            continue;
        if (point.refused.empty())
            return {};
        if (first.empty())
            first = point.refused + ": " + point.reason;
    }
    return first;
}

const CostPoint* most_accurate(const CostStudy& study)
{
    const CostPoint* best = nullptr;
    for (const CostPoint& point : study.points)
        if (point.error && (!best || *point.error < *best->error))
            best = &point;
    return best;
}

std::string result_text(const CostStudy& study, const CostPoint& point)
{
    const std::string details = settings_details(point.settings);
    const std::string unit = study.basis == CostBasis::wall  ? " ms per simulated second"
                             : study.basis == CostBasis::cpu ? " ms of CPU time per simulated second"
                                                             : " sweeps per simulated second";
    return (study.methods.size() > 1 ? point.method + ", " : "") + setting_text(point) +
           (details.empty() ? "" : ", " + details) + ", " + shown(price(point, study.basis), 3) + unit +
           " (" + study.metric + " " + shown_percent(*point.error) + ")";
}

/// Of a cheapest point that does not move the scene's own material: that, and what does instead. Else empty.
std::string material_text(const CostStudy& study, const CostTarget& target)
{
    const CostPoint& point = study.points[*target.cheapest];
    if (point.other_material.empty())
        return {};
    const bool tried = std::any_of(study.points.begin(), study.points.end(),
                                   [](const CostPoint& other) { return other.other_material.empty(); });
    return "; of another material: " + point.other_material +
           (target.own ? "; with the scene's own " + result_text(study, study.points[*target.own])
            : tried    ? "; with the scene's own it is not reached"
                       : "; no method with the scene's own was tried");
}

/// From which setting on more work is lost on the mesh.
std::string mesh_sentence(const CostStudy& study)
{
    const double mesh = study.continuum->mesh_error;
    const CostPoint* enough = nullptr;
    for (const CostPoint& point : study.points)
        if (point.error && *point.error <= mesh && point.other_material.empty() &&
            (enough == nullptr || price(point, study.basis) < price(*enough, study.basis)))
            enough = &point;
    const std::string of_mesh = "The mesh is " + shown_percent(mesh) + " off the continuum: ";
    if (enough == nullptr)
        return of_mesh + "no setting solves it as well as that.";
    return of_mesh + result_text(study, *enough) +
           ", solves it as well as that, and more work is lost on it.";
}

} // namespace

std::vector<CostFloor> cost_floors(const CostStudy& study, const CostPoint* point)
{
    std::vector<CostFloor> out;
    const auto any = [&](auto has) {
        return point ? has(*point) : std::any_of(study.points.begin(), study.points.end(), has);
    };
    const auto add = [&](const char* word, double error, const std::string& words) {
        const bool there =
            std::any_of(out.begin(), out.end(), [&](const CostFloor& f) { return f.error == error; });
        if (error > 0 && !there)
            out.push_back({word, error, words + ", " + shown(error, 3)});
    };
    add("reference", 10 * study.reference.error.value_or(0), "10 x the reference's own error");
    if (study.kind == CostKind::at_rest)
        add("rest", study.rest_tolerance, "rest test");
    if (study.has_continuum())
        add("mesh", study.continuum->mesh_error, "error of the mesh");
    for (const CostPoint& other : study.points)
    {
        const MethodKind method = method_named(other.method);
        const bool solves = method == MethodKind::implicit_euler || method == MethodKind::acad ||
                            method == MethodKind::implicit_constraints;
        if (solves && (point ? point == &other : other.error.has_value()))
            add("linear_tolerance", other.settings.linear_tolerance, "linear_tolerance");
    }
    for (const Precision precision : {Precision::float32, Precision::float64})
        if (any([&](const CostPoint& p) { return p.precision == precision; }))
            add(precision == Precision::float32 ? "float" : "double",
                precision == Precision::float32 ? 0x1p-24 : 0x1p-53,
                precision == Precision::float32 ? "one rounding of float" : "one rounding of double");
    return out;
}

std::vector<PlotFloor> plot_floors(const CostStudy& study)
{
    const std::vector<CostFloor> floors = cost_floors(study);
    const auto has = [&](std::string_view word) {
        return std::any_of(floors.begin(), floors.end(), [&](const CostFloor& f) { return f.word == word; });
    };
    // A study of both precisions is about their rounding.
    const bool of_rounding = has("float") && has("double");
    std::vector<PlotFloor> out;
    for (const CostFloor& floor : floors)
        out.push_back({floor.error, floor.words, floor.word == "reference" || floor.word == "rest",
                       of_rounding && (floor.word == "float" || floor.word == "double")});
    return out;
}

double price(const CostPoint& point, CostBasis basis)
{
    if (basis == CostBasis::sweeps)
        return point.sweeps;
    return basis == CostBasis::cpu ? point.cpu_ms.value_or(point.ms) : point.ms;
}

void rank(CostStudy& study)
{
    const double own = study.reference.error.value_or(0), floor = 10 * own;
    study.methods.clear();
    for (CostPoint& point : study.points)
    {
        point.at_floor = point.error && *point.error < floor;
        point.floor.clear();
        for (const CostFloor& one : cost_floors(study, &point))
            if (point.error && *point.error < one.error)
                point.floor += (point.floor.empty() ? "" : " ") + one.word;
        point.pareto = point.error &&
                       std::none_of(study.points.begin(), study.points.end(), [&](const CostPoint& other) {
                           return other.error && beats(other, point, floor, study.basis);
                       });
        if (study.methods.empty() || study.methods.back().name != point.method)
            study.methods.push_back(
                {point.method, targets_of(study, point.method), refusal(study, point.method)});
    }
    study.targets = targets_of(study, {});
}

std::string setting_text(const CostPoint& point)
{
    const auto count = [](std::uint32_t n, const char* what) {
        return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    const std::string substeps = count(point.substeps, "substep");
    const bool iterates = reads_iterations(method_named(point.method));
    return substeps + (iterates ? " x " + count(point.iterations, "iteration") : "") + " in " +
           std::string(to_string(point.precision));
}

std::vector<std::string> cost_sentences(const CostStudy& study)
{
    std::vector<std::string> out;
    const CostPoint* best = most_accurate(study);
    for (const CostTarget& target : study.targets)
    {
        const std::string percent = shown_percent(target.tolerance);
        if (target.cheapest)
            out.push_back(percent + ": " + result_text(study, study.points[*target.cheapest]) +
                          material_text(study, target) + ".");
        else if (best)
            out.push_back(percent + " is not reached; the best is " + result_text(study, *best) + ".");
        else
            out.push_back(percent + " is not reached; no setting has an error.");
    }
    if (study.has_continuum())
        out.push_back(mesh_sentence(study));
    return out;
}

std::vector<std::vector<std::string>> cost_table(const CostStudy& study)
{
    std::vector<std::vector<std::string>> rows{{"method"}};
    const bool counted = study.basis == CostBasis::sweeps;
    for (const CostTarget& target : study.targets)
        for (const char* what : {counted ? "sweeps/s" : "ms/s", counted ? "ms/s" : "sweeps/s", "setting"})
            rows[0].push_back(shown_percent(target.tolerance) + ": " + what);
    for (const CostMethod& method : study.methods)
    {
        rows.push_back({method.name});
        for (const CostTarget& target : method.targets)
        {
            std::vector<std::string> cells(3, method.refused.empty() ? "-" : "R");
            if (target.cheapest)
            {
                const CostPoint& point = study.points[*target.cheapest];
                const std::string details = settings_details(point.settings);
                cells = {shown(price(point, study.basis), 3), shown(counted ? point.ms : point.sweeps, 3),
                         std::to_string(point.substeps) + " x " + std::to_string(point.iterations) +
                             (details.empty() ? "" : ", " + details)};
            }
            rows.back().insert(rows.back().end(), cells.begin(), cells.end());
        }
    }
    return rows;
}

} // namespace taut
