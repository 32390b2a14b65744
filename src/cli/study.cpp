#include "taut/cli/study.hpp"

#include "taut/cli/output.hpp"

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

void add_precisions_option(CLI::App& command, std::vector<std::string>& precisions)
{
    command.add_option("--precision", precisions, "To try (default: float,double)")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double"}));
}

} // namespace taut::cli
