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

/// Calls `act`. A limit that is exceeded there is a matter of this file, and the message names it.
template <class Act>
auto naming(const std::string& file, const Act& act)
{
    try
    {
        return act();
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::limit)
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
