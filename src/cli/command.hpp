#pragma once
// What every command of the program shares: how it is chosen.

#include "taut/cli/exit_status.hpp"
#include "taut/runtime/base/error.hpp"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace taut::cli {

/// The command that the arguments chose; returns the exit status, throws taut::Error.
using Command = std::function<int()>;

/// Whether an error is a matter of the scene file: of a key of it, or of its numbers.
inline bool is_of_scene(const Error& error)
{
    const std::string text = error.what();
    switch (error.code())
    {
    case ErrorCode::limit:
    case ErrorCode::bad_timestep:
    case ErrorCode::unstable_timestep:
    case ErrorCode::degenerate_rest: return true;
    case ErrorCode::bad_input:
    case ErrorCode::unsupported:
        return text.starts_with("bodies[") || text.starts_with("method.") || text.starts_with("contact");
    default: return false;
    }
}

/// Calls `act`. What is wrong there with the scene is a matter of this file, and the message names it.
template <class Act>
auto naming(const std::string& file, const Act& act)
{
    try
    {
        return act();
    }
    catch (const Error& error)
    {
        if (!is_of_scene(error) || std::string(error.what()).starts_with(file + ":"))
            throw;
        throw Error(error.code(), file + ": " + error.what());
    }
}

// Each adds one subcommand whose parsing sets `chosen`.
void add_run(CLI::App& app, Command& chosen);
void add_plan(CLI::App& app, Command& chosen);
void add_cost(CLI::App& app, Command& chosen);
void add_compare(CLI::App& app, Command& chosen);
void add_tune(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_judge(CLI::App& app, Command& chosen);
void add_schema(CLI::App& app, Command& chosen);
void add_fabrics(CLI::App& app, Command& chosen);
void add_solve(CLI::App& app, Command& chosen);
void add_tetrahedralise(CLI::App& app, Command& chosen);
void add_sdf(CLI::App& app, Command& chosen);
void add_devices(CLI::App& app, Command& chosen);

} // namespace taut::cli
