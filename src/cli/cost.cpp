// taut cost: error against time over the settings of a method.

#include "taut/report/cost.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/progress.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"

#include <iostream>
#include <optional>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct CostCommand
{
    std::string scene, device;
    fs::path folder;
    std::vector<std::uint32_t> substeps, iterations;
    std::vector<std::string> precisions;
    std::optional<std::uint32_t> frames;
    std::optional<double> rest_seconds, timing_seconds, reference_steps;
    bool at_rest = false, moving = false, json = false;
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
        options.precisions.push_back(word == "float" ? Precision::float32 : Precision::float64);
    options.frames = command.frames.value_or(0);
    options.rest_seconds = command.rest_seconds.value_or(options.rest_seconds);
    options.timing_seconds = command.timing_seconds.value_or(options.timing_seconds);
    options.reference_steps = command.reference_steps.value_or(options.reference_steps);
    if (command.at_rest)
        options.kind = CostKind::at_rest;
    if (command.moving)
        options.kind = CostKind::moving;
    return options;
}

std::string percent(const std::optional<double>& error) { return error ? number(100 * *error, 3) : "-"; }

std::string remarks(const CostPoint& point)
{
    std::string text = point.pareto ? "front" : "";
    if (point.at_floor)
        text += std::string(text.empty() ? "" : ", ") + "at the reference's floor";
    return point.reason.empty() ? text : point.reason;
}

std::string points_table(const CostStudy& study)
{
    std::vector<std::vector<std::string>> rows{{"precision", "iterations", "substeps", study.metric + " %",
                                                "e_L %", "ms/s", "ms/s least", "CPU ms/s", "sweeps/s",
                                                "remark"}};
    for (const CostPoint& point : study.points)
    {
        const auto timed = [&](double ms) { return point.error ? number(ms, 3) : std::string("-"); };
        rows.push_back({std::string(to_string(point.precision)), std::to_string(point.iterations),
                        std::to_string(point.substeps), percent(point.error), percent(point.error_l),
                        timed(point.ms), timed(point.ms_least),
                        point.error && point.cpu_ms ? number(*point.cpu_ms, 3) : "-", number(point.sweeps, 6),
                        remarks(point)});
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
    text += points_table(study);
    for (const std::string& sentence : cost_sentences(study))
        text += sentence + "\n";
    return text;
}

void write_files(const CostStudy& study, const fs::path& folder)
{
    make_folder(folder);
    write_file(folder / "cost.csv", cost_csv(study));
    write_file(folder / "cost.svg", svg(cost_plot(study, CostAxis::time)));
    write_file(folder / "cost_work.svg", svg(cost_plot(study, CostAxis::sweeps)));
    write_file(folder / "cost.json", cost_json(study));
}

int cost(const CostCommand& command)
{
    std::vector<SceneIssue> issues;
    const Scene scene = resolve(load_scene(command.scene), &issues);
    const auto device = open_device(command.device);
    CostOptions options = study_options(command);
    if (!command.folder.empty())
        make_folder(command.folder); // before minutes of work
    const InterruptGuard guard;
    std::optional<Progress> bar;
    options.progress = [&](std::size_t done, std::size_t total) {
        if (!bar)
            bar.emplace(total);
        bar->update(done);
        return !guard.interrupted();
    };
    const CostStudy study = run_cost(scene, device, options);
    bar.reset();
    for (const SceneIssue& issue : issues)
        warn((issue.field.empty() ? "" : issue.field + ": ") + issue.text);
    if (!command.folder.empty())
        write_files(study, command.folder);
    std::cout << (command.json ? cost_json(study) : summary(study));
    return study.sound() ? kDone : kNotSound;
}

} // namespace

void add_cost(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("cost", "Measure error against time over the settings of a method");
    const auto options = std::make_shared<CostCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    add_device_option(*command, options->device);
    command->add_option("--substeps", options->substeps, "To try (default: 1,2,5,10,20,50)")->delimiter(',');
    command->add_option("--iterations", options->iterations, "To try (default: 1,2,5,10)")->delimiter(',');
    command->add_option("--precision", options->precisions, "To try (default: float,double)")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double"}));
    auto* at_rest = command->add_flag("--static", options->at_rest, "Compare the state at rest");
    auto* moving = command->add_flag("--moving", options->moving, "Compare the trajectory");
    at_rest->excludes(moving);
    command->add_option("--frames", options->frames,
                        "Moving: frames compared at most (default: the scene's)");
    command->add_option("--rest-seconds", options->rest_seconds,
                        "Static: simulated seconds at most until rest (default: 30)");
    command->add_option("--timing-seconds", options->timing_seconds,
                        "Wall seconds after which a setting is not repeated (default: 2)");
    command->add_option("--reference-steps", options->reference_steps,
                        "Moving: steps times elements that the reference R3 may take (default: 1.5e9)");
    command->add_option("--out", options->folder,
                        "Folder for cost.csv, cost.json, cost.svg and cost_work.svg");
    command->add_flag("--json", options->json, "Print the study as one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return cost(*options); }; });
}

} // namespace taut::cli
