#pragma once
// What the commands share that run many trials of one scene: options, progress, an interruption.

#include "taut/cli/command.hpp"
#include "taut/cli/interrupt.hpp"
#include "taut/cli/progress.hpp"
#include "taut/scene/scene.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace taut::cli {

/// A bar that appears with the first trial, and the answer whether to go on.
class StudyProgress
{
public:
    std::function<bool(std::size_t done, std::size_t total)> callback()
    {
        return [this](std::size_t done, std::size_t total) {
            if (!bar_)
                bar_.emplace(total);
            bar_->update(done);
            return !guard_.interrupted();
        };
    }
    /// The same without a bar.
    std::function<bool(std::size_t, std::size_t)> silent()
    {
        return [this](std::size_t, std::size_t) { return !guard_.interrupted(); };
    }
    void end() { bar_.reset(); }

private:
    InterruptGuard guard_;
    std::optional<Progress> bar_;
};

/// Says on standard error what resolve() doubted.
void warn_of(const std::vector<SceneIssue>& issues);

/// --static and --moving, which exclude each other.
void add_kind_options(CLI::App& command, bool& at_rest, bool& moving, const std::string& verb);
/// How far a study goes; empty: as the study has it by default.
struct StudyLimits
{
    std::optional<std::uint32_t> frames;
    std::optional<double> rest_seconds, timing_seconds, reference_steps;
};
/// --frames, --rest-seconds, --timing-seconds, --reference-steps; `frames` is what help says of the first.
void add_limit_options(CLI::App& command, StudyLimits& limits, const std::string& frames);
/// --precision, a list.
void add_precisions_option(CLI::App& command, std::vector<std::string>& precisions);

} // namespace taut::cli
