#pragma once
// What every command of the program shares: how it is chosen and what its exit status means.

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace taut::cli {

/// Exit status of the program. The list is closed; docs/program.md explains each.
enum Exit : int
{
    kDone = 0,
    kNotSound = 1, ///< it ran, but the result is not sound
    kBadInput = 2, ///< wrong arguments or input, or a file that cannot be read or written
    kNoDevice = 3,
};

/// The command that the arguments chose; returns the exit status, throws taut::Error.
using Command = std::function<int()>;

// Each adds one subcommand whose parsing sets `chosen`.
void add_run(CLI::App& app, Command& chosen);
void add_plan(CLI::App& app, Command& chosen);
void add_cost(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_devices(CLI::App& app, Command& chosen);

} // namespace taut::cli
