// Based on: the sweeps over mass and stiffness ratios of Macklin et al., Primal/Dual Descent Methods for
//   Dynamics, 2020: stiffness ratios hurt methods on positions, mass ratios those on multipliers.
// Departures: none.
#include "taut/report/cost_ratio.hpp"

#include "taut/plan/material.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

namespace taut {
namespace {

constexpr double kGood = 0.1; ///< the error that a sentence calls held

const char* ratio_word(RatioKind kind) { return kind == RatioKind::mass ? "mass" : "stiffness"; }

void make_heavier(Body& body, double ratio)
{
    std::vector<double> masses = vertex_masses(body);
    if (!masses.empty())
        masses.back() *= ratio;
    body.vertex_masses = std::move(masses);
}

void make_stiffer(Body& body, double ratio)
{
    const auto half = static_cast<std::uint32_t>(body.mesh.positions.size() / 2);
    std::vector<Body::Spring> springs;
    for (const StretchElement& element : stretch_elements(body))
    {
        const bool stiff = element.a >= half && element.b >= half;
        springs.push_back({element.a, element.b, element.rest_length,
                           element.compliance / (stiff ? ratio : 1), element.kind});
    }
    body.springs = std::move(springs);
    body.material.stretch_stiffness = 0;
}

/// What a point of one study has in common with points of the others.
std::string key(const CostPoint& point) { return settings_text(point.settings); }

/// Of one setting: its points, in the order of the ratios.
struct Row
{
    std::string name, method;
    std::vector<const CostPoint*> points;
    std::vector<double> ratios;
};

std::vector<Row> rows_of(const RatioStudy& study)
{
    std::vector<Row> out;
    for (std::size_t r = 0; r < study.studies.size(); ++r)
        for (const CostPoint& point : study.studies[r].points)
        {
            auto found =
                std::find_if(out.begin(), out.end(), [&](const Row& row) { return row.name == key(point); });
            if (found == out.end())
                found = out.insert(found, {key(point), point.method, {}, {}});
            found->points.push_back(&point);
            found->ratios.push_back(study.ratios[r]);
        }
    return out;
}

} // namespace

Scene ratio_scene(const Scene& resolved, RatioKind kind, double ratio)
{
    Scene out = resolved;
    for (Body& body : out.bodies)
        kind == RatioKind::mass ? make_heavier(body, ratio) : make_stiffer(body, ratio);
    return out;
}

std::vector<double> usual_ratios(RatioKind kind)
{
    std::vector<double> out{1, 10, 100, 1e3, 1e4, 1e5};
    if (kind == RatioKind::stiffness)
        out.push_back(1e6);
    return out;
}

RatioStudy run_ratios(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options,
                      RatioKind kind, const std::vector<double>& ratios)
{
    if (ratios.empty() || std::any_of(ratios.begin(), ratios.end(), [](double r) { return !(r > 0); }))
        throw Error(ErrorCode::bad_input, "ratios to try must be a list of numbers above 0.");
    if (kind == RatioKind::stiffness &&
        std::any_of(scene.bodies.begin(), scene.bodies.end(),
                    [](const Body& body) { return !body.mesh.tetrahedra.empty(); }))
        throw Error(ErrorCode::bad_input, "ratios of stiffness are of springs: a body of tetrahedra has one "
                                          "material; take ratios of mass.");
    RatioStudy out{scene.name, kind, ratios, {}};
    for (const double ratio : ratios)
    {
        out.studies.push_back(run_cost(ratio_scene(scene, kind, ratio), device, options));
        if (out.studies.back().interrupted)
        {
            out.ratios.resize(out.studies.size());
            break;
        }
    }
    return out;
}

std::vector<std::string> ratio_sentences(const RatioStudy& study)
{
    std::vector<std::string> out;
    const std::string what = std::string(ratio_word(study.kind)) + " ratio of ";
    for (const Row& row : rows_of(study))
    {
        // What has no result says nothing either way: it is named, and passed over.
        std::optional<double> held;
        const CostPoint *above = nullptr, *gap = nullptr;
        std::string gaps, first_above;
        for (std::size_t i = 0; i < row.points.size(); ++i)
        {
            const CostPoint& point = *row.points[i];
            if (!point.error)
            {
                gap = gap ? gap : &point;
                gaps += (gaps.empty() ? "" : ", ") + shown(row.ratios[i], 3);
            }
            else if (!above && *point.error <= kGood)
                held = row.ratios[i];
            else if (!above)
            {
                above = &point;
                first_above = shown(row.ratios[i], 3);
            }
        }
        std::string text = row.name + ": ";
        text += held    ? "within 10 % up to a " + what + shown(*held, 3)
                : above ? "above 10 % from the start"
                        : "no result";
        if (above)
            text += "; at " + first_above + " the error is " + shown_percent(*above->error);
        if (gap)
            text += "; nothing at " + gaps +
                    (gap->refused.empty() ? ": " + gap->reason : ": it refuses (" + gap->refused + ")");
        out.push_back(text + ".");
    }
    return out;
}

std::string ratio_csv(const RatioStudy& study)
{
    std::string out;
    for (std::size_t r = 0; r < study.studies.size(); ++r)
    {
        std::istringstream rows(cost_csv(study.studies[r]));
        std::string row;
        for (bool head = true; std::getline(rows, row); head = false)
            if (!head || r == 0)
                out += (head ? std::string("ratio") : shown(study.ratios[r], 3)) + "," + row + "\n";
    }
    return out;
}

Plot ratio_plot(const RatioStudy& study)
{
    Plot plot;
    plot.title = "Error against the ratio of " + std::string(ratio_word(study.kind)) + ": " + study.scene;
    plot.x_label = std::string(ratio_word(study.kind)) + " ratio";
    plot.y_label = "error " + (study.studies.empty() ? "" : study.studies[0].metric);
    plot.front = false;
    for (const Row& row : rows_of(study))
    {
        PlotSeries series{row.name, {}, false, "", method_style(method_named(row.method))};
        std::string gaps;
        for (std::size_t i = 0; i < row.points.size(); ++i)
            if (row.points[i]->error)
                series.points.push_back({row.ratios[i], *row.points[i]->error, "", 0});
            else
                gaps += (gaps.empty() ? " at " : ", ") + shown(row.ratios[i], 3);
        const auto gap = std::find_if(row.points.begin(), row.points.end(),
                                      [](const CostPoint* point) { return !point->error; });
        if (!gaps.empty())
            plot.gaps.push_back(row.name + gaps + ": " + (*gap)->reason);
        if (!series.points.empty())
            add_variant(plot, std::move(series));
    }
    plot.y_most = off_the_top(plot.series, 1);
    for (std::size_t r = 0; r < study.studies.size(); ++r)
        plot.caption.push_back("Ratio " + shown(study.ratios[r], 3) + ": reference class " +
                               study.studies[r].reference.name + ".");
    return plot;
}

} // namespace taut
