// taut cost: error against time over the settings of one or several methods.

#include "taut/report/cost.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/study.hpp"
#include "taut/report/ablation.hpp"
#include "taut/report/cost_energy.hpp"
#include "taut/report/cost_ratio.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct CostCommand
{
    std::string scene, device;
    fs::path folder;
    std::vector<std::uint32_t> substeps, iterations;
    std::vector<std::string> precisions, methods;
    std::string rank;
    StudyLimits limits;
    std::optional<double> rest_tolerance, linear_tolerance;
    std::optional<std::uint32_t> repeats;
    std::string ratio;
    std::vector<double> ratios;
    bool at_rest = false, moving = false, conserved = false, ablation = false, json = false;
    bool continuum = false;
};

CostOptions study_options(const CostCommand& command)
{
    CostOptions options;
    if (!command.substeps.empty())
        options.substeps = command.substeps;
    if (!command.iterations.empty())
        options.iterations = command.iterations;
    if (!command.precisions.empty())
        options.precisions.clear();
    for (const std::string& word : command.precisions)
        options.precisions.push_back(option_named<Precision>(word));
    if (!command.methods.empty())
    {
        options.methods = methods_listed(command.methods);
        options.designed = command.substeps.empty() && command.iterations.empty();
        if (command.precisions.empty())
            options.precisions = {Precision::float32};
    }
    options.basis = command.rank == "cpu"    ? CostBasis::cpu
                    : command.rank == "work" ? CostBasis::sweeps
                                             : CostBasis::wall;
    options.frames = command.limits.frames.value_or(0);
    options.rest_seconds = command.limits.rest_seconds.value_or(options.rest_seconds);
    options.timing_seconds = command.limits.timing_seconds.value_or(options.timing_seconds);
    options.reference_steps = command.limits.reference_steps.value_or(options.reference_steps);
    options.rest_tolerance = command.rest_tolerance.value_or(options.rest_tolerance);
    options.linear_tolerance = command.linear_tolerance;
    options.repeats = command.repeats.value_or(static_cast<std::uint32_t>(options.repeats));
    if (command.at_rest)
        options.kind = CostKind::at_rest;
    if (command.moving)
        options.kind = CostKind::moving;
    return options;
}

std::string percent(const std::optional<double>& error) { return error ? number(100 * *error, 3) : "-"; }

std::string remarks(const CostPoint& point)
{
    std::string text = settings_details(point.settings);
    const auto say = [&](const std::string& words) { text += (text.empty() ? "" : "; ") + words; };
    if (point.pareto)
        say("front");
    if (point.at_floor)
        say("at the reference's floor");
    if (!point.refused.empty())
        say("refused, " + point.refused);
    if (!point.reason.empty())
        say(point.reason);
    return text;
}

std::string points_table(const CostStudy& study)
{
    const bool several = study.methods.size() > 1;
    std::vector<std::vector<std::string>> rows{{"precision", "iterations", "substeps", study.metric + " %",
                                                "e_L %", "ms/s", "ms/s least", "CPU ms/s", "sweeps/s",
                                                "remark"}};
    if (several)
        rows[0].insert(rows[0].begin(), "method");
    const auto beside_error = static_cast<std::ptrdiff_t>(several ? 5 : 4); // columns
    if (study.has_continuum())
        rows[0].insert(rows[0].begin() + beside_error, "continuum %");
    if (study.contact)
        rows[0].insert(rows[0].begin() + beside_error, {"impulse %", "friction %", "depth mm"});
    for (const CostPoint& point : study.points)
    {
        const auto timed = [&](double ms) { return point.error ? number(ms, 3) : std::string("-"); };
        rows.push_back({std::string(to_string(point.precision)), std::to_string(point.iterations),
                        std::to_string(point.substeps), percent(point.error), percent(point.error_l),
                        timed(point.ms), timed(point.ms_least),
                        point.error && point.cpu_ms ? number(*point.cpu_ms, 3) : "-", number(point.sweeps, 6),
                        remarks(point)});
        if (several)
            rows.back().insert(rows.back().begin(), point.method);
        if (study.has_continuum())
            rows.back().insert(rows.back().begin() + beside_error, percent(point.error_continuum));
        if (study.contact)
        {
            const auto share = [&](double cost::ContactError::*error) {
                return percent(point.contact ? std::optional(*point.contact.*error) : std::nullopt);
            };
            rows.back().insert(rows.back().begin() + beside_error,
                               {share(&cost::ContactError::impulse), share(&cost::ContactError::friction),
                                point.contact ? number(1000 * point.contact->depth, 3) : "-"});
        }
    }
    return table(rows);
}

std::string summary(const CostStudy& study)
{
    std::string text = "What accuracy costs: " + study.scene + " on " + study.device.name + " (" +
                       study.device.executor + ")\n";
    text += "reference  " + study.reference.name + ": " + study.reference.text + "\n";
    for (const std::string& passed : study.reference.passed)
        text += "           passed over: " + passed + "\n";
    if (study.continuum)
        text +=
            "continuum  " +
            (study.has_continuum() ? "R1: " + study.continuum->text : "none: " + study.continuum->reason) +
            ".\n";
    text += points_table(study);
    if (study.methods.size() > 1)
        text += "cheapest by method (- not reached, R refused):\n" + table(cost_table(study));
    for (const std::string& sentence : cost_sentences(study))
        text += sentence + "\n";
    return text;
}

/// These studies compare methods at the same work, and at one precision unless the command says more.
CostOptions fixed_work(const CostCommand& command, CostOptions options)
{
    options.designed = false;
    if (command.substeps.empty())
        options.substeps = {16};
    if (command.iterations.empty())
        options.iterations = {1};
    if (command.precisions.empty())
        options.precisions = {Precision::float32};
    options.timing_seconds = command.limits.timing_seconds.value_or(0);
    return options;
}

void write_files(const CostStudy& study, const fs::path& folder)
{
    make_folder(folder);
    write_file(folder / "cost.csv", cost_csv(study));
    write_file(folder / "cost.svg", svg(cost_plot(study, CostAxis::time)));
    write_file(folder / "cost_work.svg", svg(cost_plot(study, CostAxis::sweeps)));
    if (study.methods.size() > 1)
    {
        write_file(folder / "cost_substeps.svg", svg(convergence_plot(study, CostSplit::substeps)));
        write_file(folder / "cost_iterations.svg", svg(convergence_plot(study, CostSplit::iterations)));
    }
    write_file(folder / "cost.json", cost_json(study));
    write_file(folder / "cost_gaps.md", gap_table(cost_plot(study, CostAxis::time)));
}

int ratios(const CostCommand& command, const Scene& scene, CostOptions options)
{
    const RatioKind kind = command.ratio == "mass" ? RatioKind::mass : RatioKind::stiffness;
    const RatioStudy study = run_ratios(scene, open_device(command.device), fixed_work(command, options),
                                        kind, command.ratios.empty() ? usual_ratios(kind) : command.ratios);
    if (!command.folder.empty())
    {
        write_file(command.folder / ("ratio_" + command.ratio + ".csv"), ratio_csv(study));
        write_file(command.folder / ("ratio_" + command.ratio + ".svg"), svg(ratio_plot(study)));
        write_file(command.folder / ("ratio_" + command.ratio + "_gaps.md"), gap_table(ratio_plot(study)));
    }
    std::cout << "Error against the ratio of " << command.ratio << ": " << study.scene << "\n";
    for (const std::string& sentence : ratio_sentences(study))
        std::cout << sentence << "\n";
    return kDone;
}

int conserved(const CostCommand& command, const Scene& scene, CostOptions options)
{
    const EnergyStudy study = run_energy(scene, open_device(command.device), fixed_work(command, options));
    if (!command.folder.empty())
    {
        write_file(command.folder / "energy.csv", energy_csv(study));
        write_file(command.folder / "energy.svg", svg(energy_plot(study, Conserved::energy)));
        write_file(command.folder / "momentum.svg", svg(energy_plot(study, Conserved::momentum)));
    }
    std::cout << "Energy and momentum: " << study.scene << "\n";
    for (const std::string& sentence : energy_sentences(study))
        std::cout << sentence << "\n";
    return kDone;
}

int ablation(const CostCommand& command, const Scene& scene, const std::vector<SceneIssue>& issues)
{
    const double whole = std::max(std::ceil(scene.duration / scene.timestep - 1e-6), 1.0);
    const std::uint64_t asked = command.limits.frames.value_or(0);
    StudyProgress progress;
    const Ablation study =
        run_ablation(scene, open_device(command.device),
                     asked > 0 ? asked : static_cast<std::uint64_t>(whole), progress.callback());
    progress.end();
    warn_of(issues);
    if (!command.folder.empty())
        write_file(command.folder / "ablation.csv", ablation_csv(study));
    std::cout << "What each effect costs: " << study.scene << " on " << study.device.name << " ("
              << study.device.executor << "), " << study.frames << " frames\n\n"
              << ablation_markdown(study);
    return kDone;
}

int cost(const CostCommand& command)
{
    std::vector<SceneIssue> issues;
    const Scene scene = resolve_file(command.scene, {}, &issues);
    CostOptions options = study_options(command);
    if (!command.folder.empty())
        make_folder(command.folder); // before minutes of work
    if (command.ablation)
        return ablation(command, scene, issues);
    StudyProgress progress;
    options.progress = progress.silent();
    if (!command.ratio.empty())
        return ratios(command, scene, options);
    if (command.conserved)
        return conserved(command, scene, options);
    const auto device = open_device(command.device);
    if (command.continuum && !command.at_rest && cost_kind(scene) != CostKind::at_rest)
        throw Error(ErrorCode::bad_input,
                    "--continuum needs a scene that comes to rest: held by pins that stand "
                    "still, without colliders, with damping; or take --static");
    if (command.continuum)
        options.continuum = continuum_reference(load_scene(command.scene));
    options.progress = progress.callback();
    const CostStudy study = run_cost(scene, device, options);
    progress.end();
    warn_of(issues);
    if (!command.folder.empty())
        write_files(study, command.folder);
    std::cout << (command.json ? cost_json(study) : summary(study));
    return study.sound() ? kDone : kNotSound;
}

/// How a study measures each setting.
void add_measuring_options(CLI::App& command, CostCommand& options)
{
    command
        .add_option("--repeats", options.repeats,
                     "Timed repetitions of each setting, in turns with all others (default: 10)")
        ->check(whole_number(1, 1000));
    command
        .add_option(
            "--rest-tolerance", options.rest_tolerance,
            "Static: what a scene moves by in a second at rest, of its displacement (default: 1e-5); "
            "below it errors depend on when rest is called")
        ->check(number_between(0, 0.1, Ends::closed));
    command
        .add_option("--linear-tolerance", options.linear_tolerance,
                     "Of every linear solve (default: the scene's, and what designs vary)")
        ->check(number_between(0, 1, Ends::open));
}

} // namespace

void add_cost(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("cost", "Measure error against time over the settings of a method");
    const auto options = std::make_shared<CostCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    add_device_option(*command, options->device);
    add_costs_option(*command);
    command
        ->add_option("--methods", options->methods,
                     "To try, or \"all\" (default: xpbd); without lists each by its own design, in float")
        ->delimiter(',');
    command->add_option("--rank", options->rank, "What cheaper means (default: wall)")
        ->check(CLI::IsMember({"wall", "cpu", "work"}));
    command->add_option("--substeps", options->substeps, "To try (default: 1,2,5,10,20,50)")
        ->delimiter(',')
        ->check(whole_number(1, 1000));
    command->add_option("--iterations", options->iterations, "To try (default: 1,2,5,10)")
        ->delimiter(',')
        ->check(whole_number(1, 1000));
    add_precisions_option(*command, options->precisions);
    add_kind_options(*command, options->at_rest, options->moving, "Compare");
    auto* ratio = command->add_option("--ratio", options->ratio,
                                      "Instead: error against a growing ratio of masses or stiffnesses");
    ratio->check(CLI::IsMember({"mass", "stiffness"}));
    command->add_option("--ratios", options->ratios, "To try (default: 1,10,... to 1e5 or 1e6)")
        ->delimiter(',')
        ->check(number_between(0, std::numeric_limits<double>::infinity(), Ends::open))
        ->needs(ratio);
    auto* kept = command->add_flag("--conserved", options->conserved,
                                   "Instead: energy and momentum against time, of a scene that keeps them");
    kept->excludes(ratio);
    auto* without =
        command->add_flag("--ablation", options->ablation,
                          "Instead: time, bytes and dispatches of each effect, by leaving it out");
    without->excludes(ratio)->excludes(kept);
    for (const char* other :
         {"--methods", "--substeps", "--iterations", "--precision", "--static", "--moving"})
        without->excludes(command->get_option(other));
    add_limit_options(*command, options->limits,
                      "Moving: frames compared at most (default: the scene's)");
    add_measuring_options(*command, *options);
    command->add_option("--out", options->folder,
                        "Folder for cost.csv, cost.json, cost.svg, cost_work.svg and cost_gaps.md (what has "
                        "no point); with several methods also "
                        "for cost_substeps.svg and cost_iterations.svg");
    auto* beside = command->add_flag("--continuum", options->continuum,
                                     "Static: also give each error against the continuum, from finer meshes");
    beside->excludes(ratio)->excludes(kept)->excludes(without)->excludes(command->get_option("--moving"));
    command->add_flag("--json", options->json, "Print the study as one JSON object")->excludes(without);
    command->callback([&chosen, options] { chosen = [options] { return cost(*options); }; });
}

} // namespace taut::cli
