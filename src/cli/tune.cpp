// taut tune: the cheapest method and setting that keeps an error.

#include "taut/report/tune.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/study.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/settings.hpp"

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>

namespace taut::cli {
namespace {

struct TuneCommand
{
    std::string scene, device;
    std::vector<std::string> methods, precisions;
    std::string by;
    std::optional<double> error;
    StudyLimits limits;
    std::optional<double> seconds;
    bool at_rest = false, moving = false, prior_only = false, json = false;
};

constexpr double kSeconds = 50; ///< of a search unless the command says more

TuneOptions tune_options(const TuneCommand& command)
{
    TuneOptions options;
    options.error = command.error.value_or(options.error);
    options.loosen = !command.error;
    options.by = command.by == "volume" ? TuneCriterion::volume : TuneCriterion::motion;
    const bool all =
        std::find(command.methods.begin(), command.methods.end(), "all") != command.methods.end();
    if (!command.methods.empty() && !all) // "all" names none: those of another material are left out
        options.methods = methods_listed(command.methods);
    if (!command.precisions.empty())
        options.precisions.clear();
    for (const std::string& word : command.precisions)
        options.precisions.push_back(option_named<Precision>(word));
    options.kind = command.at_rest  ? CostKind::at_rest
                   : command.moving ? CostKind::moving
                                    : CostKind::automatic;
    options.frames = command.limits.frames.value_or(static_cast<std::uint32_t>(options.frames));
    options.rest_seconds = command.limits.rest_seconds.value_or(options.rest_seconds);
    options.timing_seconds = command.limits.timing_seconds.value_or(options.timing_seconds);
    options.reference_steps = command.limits.reference_steps.value_or(options.reference_steps);
    options.prior_only = command.prior_only;
    options.seconds =
        command.seconds.value_or(command.prior_only ? std::numeric_limits<double>::infinity() : kSeconds);
    return options;
}

/// One row for each method and stage: how many fell there, and the first one's reason.
std::string rejected_table(const TuneResult& result)
{
    struct Group
    {
        MethodKind method;
        std::string stage, text;
        std::size_t count;
    };
    std::vector<Group> groups;
    for (const TuneRejection& rejection : result.rejected)
    {
        const auto same = [&](const Group& g) {
            return g.method == rejection.settings.type && g.stage == rejection.stage;
        };
        const auto found = std::find_if(groups.begin(), groups.end(), same);
        if (found != groups.end())
            ++found->count;
        else
            groups.push_back({rejection.settings.type, rejection.stage,
                              settings_text(rejection.settings) + ": " + rejection.reason, 1});
    }
    std::string text;
    for (const Group& group : groups)
        text += "  " + std::string(to_string(group.method)) + ", " + std::to_string(group.count) + " by " +
                group.stage + (group.count > 1 ? "; the first: " : ": ") + group.text + "\n";
    return text;
}

/// A group of lines for each reason.
std::string not_tried_table(const TuneResult& result)
{
    std::vector<std::pair<std::string, std::vector<MethodSettings>>> groups;
    for (const TuneLeft& left : result.not_tried)
    {
        auto found = std::find_if(groups.begin(), groups.end(),
                                  [&](const auto& group) { return group.first == left.reason; });
        if (found == groups.end())
            found = groups.insert(found, {left.reason, {}});
        found->second.push_back(left.settings);
    }
    std::string text;
    for (const auto& [reason, settings] : groups)
    {
        text += "not tried  " + std::to_string(settings.size()) + " settings: " + reason + "\n";
        for (const std::string& line : listed_settings(settings))
            text += "  " + line + "\n";
    }
    return text;
}

std::string found_text(const TuneResult& result)
{
    std::string text = "\"method\": " + settings_block(result.settings) + "\n";
    text += "error      " + shown_percent(result.confirmed_error) + " confirmed on " +
            std::to_string(result.starts) + (result.starts == 1 ? " start, " : " starts, ") +
            shown_percent(result.predicted_error) + " predicted\n";
    text += "time       ";
    if (result.ms)
        text += number(*result.ms, 3) + " ms per simulated second";
    if (result.cpu_ms)
        text += " (" + number(*result.cpu_ms, 3) + " ms of CPU time)";
    text += (result.ms ? ", " : "") + number(result.predicted_ms, 3) + " ms predicted\n";
    if (result.kept)
        text += "This is the scene's own setting: nothing else is 10 % cheaper.\n";
    return text;
}

std::string summary(const TuneResult& result)
{
    const std::string span = result.kind == CostKind::at_rest ? " at rest"
                             : result.frames > 0 ? " over " + std::to_string(result.frames) + " frames"
                                                 : ""; // without a reference there are none
    std::string text = "Cheapest setting of " + result.scene + " on " + result.device.name + " (" +
                       result.device.executor + ") with " + result.metric + " of at most " +
                       shown_percent(result.bound) + span + "\n";
    text += "reference  " + result.reference.name + ": " + result.reference.text + "\n";
    for (const std::string& passed : result.reference.passed)
        text += "           passed over: " + passed + "\n";
    if (result.interrupted)
        text += "Interrupted: settings that were not tried may be cheaper, or keep the error.\n";
    text += result.found ? found_text(result) : result.why + "\n";
    for (const std::string& note : result.notes)
        text += "note       " + note + "\n";
    text += "tried      " + std::to_string(result.tried.size()) + " settings\n";
    for (const std::string& line : listed_settings(result.tried))
        text += "  " + line + "\n";
    text += "rejected   " + std::to_string(result.rejected.size()) + " settings\n" + rejected_table(result);
    return text + not_tried_table(result);
}

int tune_scene(const TuneCommand& command)
{
    std::vector<SceneIssue> issues;
    const Scene scene = resolve_file(command.scene, {}, &issues);
    const auto device = open_device(command.device);
    TuneOptions options = tune_options(command);
    StudyProgress progress;
    options.progress = progress.callback();
    const TuneResult result = tune(scene, device, options);
    progress.end();
    warn_of(issues);
    std::cout << (command.json ? tune_json(result) : summary(result));
    return result.found ? kDone : kNotSound;
}

} // namespace

void add_tune(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("tune", "Find the cheapest method and setting that keeps an error");
    const auto options = std::make_shared<TuneCommand>();
    command->add_option("scene", options->scene, "Scene file (JSON)")->required();
    add_device_option(*command, options->device);
    add_costs_option(*command);
    command
        ->add_option("--error", options->error,
                     "Bound on the error, 0.01 is 1 % (default: 0.01, or the first looser one that has a "
                     "setting)")
        ->check(number_between(0, 1, Ends::open, "; 0.01 is 1 %"));
    command->add_option("--by", options->by, "What the error is of (default: motion)")
        ->check(CLI::IsMember({"motion", "volume"}));
    command
        ->add_option("--methods", options->methods,
                     "To try (default, and \"all\": all but those of another material)")
        ->delimiter(',');
    add_precisions_option(*command, options->precisions);
    add_kind_options(*command, options->at_rest, options->moving, "Bound the error of");
    add_limit_options(*command, options->limits,
                      "Moving: frames compared at most (default: 120)");
    command
        ->add_option("--seconds", options->seconds,
                     "Wall seconds of the search; what is not tried until then is named (default: 50, with "
                     "--prior-only no limit)")
        ->check(number_between(0, std::numeric_limits<double>::infinity(), Ends::closed));
    command->add_flag("--prior-only", options->prior_only,
                      "Go by predicted cost alone and time nothing: the same answer on every machine");
    command->add_flag("--json", options->json, "Print the result as one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return tune_scene(*options); }; });
}

} // namespace taut::cli
