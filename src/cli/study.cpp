#include "taut/cli/study.hpp"

#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"

#include <limits>

namespace taut::cli {

void warn_of(const std::vector<SceneIssue>& issues)
{
    for (const SceneIssue& issue : issues)
        warn((issue.field.empty() ? "" : issue.field + ": ") + issue.text);
}

void add_kind_options(CLI::App& command, bool& at_rest, bool& moving, const std::string& verb)
{
    auto* first = command.add_flag("--static", at_rest, verb + " the state at rest");
    auto* second = command.add_flag("--moving", moving, verb + " the trajectory");
    first->excludes(second);
}

void add_limit_options(CLI::App& command, StudyLimits& limits, const std::string& frames)
{
    constexpr double kAny = std::numeric_limits<double>::infinity();
    command.add_option("--frames", limits.frames, frames)->check(whole_number(1));
    command
        .add_option("--rest-seconds", limits.rest_seconds,
                    "Static: simulated seconds at most until rest (default: 30)")
        ->check(number_between(1, 1e6, Ends::closed));
    command
        .add_option("--timing-seconds", limits.timing_seconds,
                    "Wall seconds after which a setting is not repeated (default: 2)")
        ->check(number_between(0, kAny, Ends::closed));
    command
        .add_option("--reference-steps", limits.reference_steps,
                    "Moving: steps times elements that a reference R3 may take (default: 1.5e9)")
        ->check(number_between(0, kAny, Ends::closed));
}

void add_precisions_option(CLI::App& command, std::vector<std::string>& precisions)
{
    command.add_option("--precision", precisions, "To try (default: float,double)")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double"}));
}

} // namespace taut::cli
