#include "taut/report/compare.hpp"

#include "taut/report/errors.hpp"
#include "taut/report/median.hpp"
#include "taut/runtime/base/csv.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <chrono>

namespace taut {
namespace {

using Clockwork = std::chrono::steady_clock;

void add_sample(const World& world, std::uint64_t frame, TimeSeries& series, CompareRow& row)
{
    row.report = measure(world);
    std::optional<SolverReport> solved;
    if (!world.plan().solvers.empty())
        solved = row.report.solver;
    std::optional<double> volume;
    if (row.report.volume.any)
        volume = row.report.volume.ratio;
    series.add(frame, row.report.time, row.report.max_stretch, row.report.active_share, solved, volume);
    row.worst_stretch = std::max(row.worst_stretch, row.report.max_stretch);
    row.worst_rms_stretch = std::max(row.worst_rms_stretch, row.report.rms_stretch);
    row.smallest_volume = std::min(row.smallest_volume, row.report.volume.least);
    row.mean_volume += row.report.volume.ratio; // a sum until the run is over
    ++row.measured;
    row.highest_energy =
        std::max(row.highest_energy, row.report.kinetic_energy + row.report.potential_energy);
}

/// Residuals, where the run got to its end, and what they say of it.
void judge_rest(const World& world, bool ended, CompareRow& row)
{
    try
    {
        if (ended)
            row.residuals = residuals_ahead(world);
        judge_residuals(world.scene(), row.residuals, row.report);
    }
    catch (const Error&)
    {
        // The copy is larger than the world: where it does not fit, the run stands without residuals.
    }
}

using Progress = std::function<bool()>;

bool stopped(const Progress& progress) { return progress && !progress(); }

void run(World& world, std::uint64_t frames, const Progress& progress, CompareRow& row)
{
    TimeSeries series(frames);
    add_sample(world, 0, series, row);
    row.highest_energy = row.report.kinetic_energy + row.report.potential_energy;
    std::vector<double> times;
    const auto goes_on = [&] { return rank(row.report.status) < rank(Status::diverged); };
    for (std::uint64_t k = 1; k <= frames && goes_on(); ++k)
    {
        row.interrupted = stopped(progress);
        if (row.interrupted)
        {
            add_sample(world, k - 1, series, row);
            break;
        }
        const auto start = Clockwork::now();
        world.step();
        world.device().wait();
        times.push_back(std::chrono::duration<double, std::milli>(Clockwork::now() - start).count());
        if (series.due(k))
            add_sample(world, k, series, row);
    }
    row.series = series.list();
    row.mean_volume /= row.measured;
    if (!row.interrupted)
        judge_rest(world, goes_on(), row);
    else if (row.report.status == Status::completed)
        row.report.status = Status::interrupted;
    row.step_ms = median(std::move(times));
    row.positions = world.positions();
}

CompareRow row_of(const Variant& variant, std::uint64_t frames, const Progress& progress)
{
    CompareRow row;
    row.label = variant.label;
    row.method = to_string(variant.scene.method.type);
    row.executor = variant.device->info().executor;
    row.interrupted = stopped(progress);
    if (row.interrupted)
    {
        row.refusal = "interrupted: not run";
        return row;
    }
    try
    {
        World world(variant.scene, variant.device);
        row.springs = measure(world).springs;
        run(world, frames, progress, row);
    }
    catch (const Error& error)
    {
        row.refusal = std::string(to_string(error.code())) + ": " + error.what();
    }
    return row;
}

std::vector<std::string> head(bool volume)
{
    std::vector<std::string> out = {"variant",        "method",
                                    "executor",       "ms a step",
                                    "worst strain %", "largest strain at the end %",
                                    "rms strain at the end %"};
    if (volume)
        out.insert(out.end(), {"least volume %", "mean volume %", "volume at the end %", "inverted"});
    out.insert(out.end(), {"energy at the end J", "residual", "dual residual", "difference e_L %", "status"});
    return out;
}

bool any_volume(const std::vector<CompareRow>& rows)
{
    return std::any_of(rows.begin(), rows.end(), [](const CompareRow& row) { return row.report.volume.any; });
}

/// Nothing where there is none.
std::string residual(double value) { return value < 0 ? "" : shown(value, 2); }

std::string csv_line(const std::vector<std::string>& cells_of_row)
{
    std::string text;
    for (const std::string& cell : cells_of_row)
        text += (text.empty() ? "" : ",") + csv_cell(cell);
    return text + "\n";
}

/// The cells of a row; `percent` of strains. `volume`: a row of the table has one.
std::vector<std::string> cells(const CompareRow& row, bool volume)
{
    const StepReport& r = row.report;
    std::vector<std::string> out = {row.label, row.method, row.executor};
    if (!row.refusal.empty())
    {
        out.push_back(row.interrupted ? "not run" : "refused");
        out.resize(head(volume).size() - 1);
        out.push_back(row.refusal);
        return out;
    }
    const double percent = 100;
    const auto strain = [&](double value) { return row.springs ? shown(percent * value, 3) : ""; };
    out.insert(out.end(), {shown(row.step_ms, 3), strain(row.worst_stretch), strain(r.max_stretch),
                           strain(r.rms_stretch)});
    if (volume)
        out.insert(out.end(), {shown(percent * row.smallest_volume, 4), shown(percent * row.mean_volume, 4),
                               shown(percent * r.volume.ratio, 4), std::to_string(r.volume.inverted)});
    out.insert(out.end(),
               {shown(r.kinetic_energy + r.potential_energy, 4), residual(row.residuals.primal),
                residual(row.residuals.dual),
                row.difference ? shown(percent * *row.difference, 3) : "", std::string(to_string(r.status))});
    return out;
}

} // namespace

std::vector<CompareRow> compare(const std::vector<Variant>& variants, std::uint64_t frames,
                                const Progress& progress)
{
    if (variants.empty())
        throw Error(ErrorCode::bad_input, "there is nothing to compare: give at least one variant");
    std::vector<CompareRow> rows;
    const CompareRow* first = nullptr;
    rows.reserve(variants.size());
    for (const Variant& variant : variants)
    {
        rows.push_back(row_of(variant, frames, progress));
        CompareRow& row = rows.back();
        if (row.refusal.empty() && first == nullptr)
            first = &row;
        else if (row.refusal.empty() && !row.interrupted && row.positions.size() == first->positions.size())
            row.difference =
                largest_error(error_weights(make_model(variant.scene)), row.positions, first->positions);
    }
    return rows;
}

std::string compare_markdown(const std::vector<CompareRow>& rows)
{
    const auto line = [](const std::vector<std::string>& cells_of_row) {
        std::string text = "|";
        for (const std::string& cell : cells_of_row)
            text += " " + cell + " |";
        return text + "\n";
    };
    const bool volume = any_volume(rows);
    std::string text = line(head(volume)) + "|";
    for (std::size_t column = 0; column < head(volume).size(); ++column)
        text += column < 3 ? "---|" : "---:|";
    text += "\n";
    for (const CompareRow& row : rows)
        text += line(cells(row, volume));
    return text;
}

std::string compare_csv(const std::vector<CompareRow>& rows)
{
    const bool volume = any_volume(rows);
    std::string text = csv_line(head(volume));
    for (const CompareRow& row : rows)
        text += csv_line(cells(row, volume));
    return text;
}

} // namespace taut
