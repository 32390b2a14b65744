// The program `taut`. Everything that goes wrong ends here in one sentence on standard error.

#include "taut/cli/command.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/version.hpp"

#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>

namespace {

using namespace taut;

int complain(const std::string& sentence, int status)
{
    std::cout.flush();
    std::fprintf(stderr, "taut: %s\n", sentence.c_str());
    return status;
}

/// Arguments to a command; kDone in `status` with an empty command after --help or --version.
cli::Command parse(int argc, char** argv, int& status)
{
    CLI::App app(
        "Simulates cloth and solves sparse systems: one set of compute kernels on Vulkan, OpenGL and "
        "the CPU.",
        "taut");
    app.set_version_flag("--version", "taut " TAUT_VERSION);
    app.require_subcommand(1);
    cli::Command chosen;
    cli::add_run(app, chosen);
    cli::add_plan(app, chosen);
    cli::add_cost(app, chosen);
    cli::add_compare(app, chosen);
    cli::add_tune(app, chosen);
    cli::add_check(app, chosen);
    cli::add_judge(app, chosen);
    cli::add_schema(app, chosen);
    cli::add_fabrics(app, chosen);
    cli::add_solve(app, chosen);
    cli::add_tetrahedralise(app, chosen);
    cli::add_sdf(app, chosen);
    cli::add_devices(app, chosen);
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::Success& wish) // --help, --version
    {
        app.exit(wish);
        return {};
    }
    catch (const CLI::ParseError& error)
    {
        const auto named = [&](CLI::App* command) { return command->get_name() == argv[1]; };
        const bool unknown = argc > 1 && argv[1][0] != '-' && app.get_subcommands(named).empty();
        const std::string what =
            unknown ? "there is no command \"" + std::string(argv[1]) + "\"" : cli::sentence(error);
        const bool chose = !unknown && argc > 1 && !app.get_subcommands(named).empty();
        const std::string where = chose ? "taut " + std::string(argv[1]) + " --help lists its options"
                                        : "taut --help lists commands";
        status = complain(what + " (" + where + ")", cli::kBadInput);
        return {};
    }
    return chosen;
}

int execute(const cli::Command& command)
{
    try
    {
        const int status = command();
        std::cout.flush();
        return std::cout ? status : complain("standard output could not be written.", cli::kBadInput);
    }
    catch (const Error& error)
    {
        return complain(error.what(), cli::exit_status(error.code()));
    }
    catch (const std::bad_alloc&)
    {
        return complain("the host has no memory left for this scene or system; use a smaller one.",
                        cli::exit_status(ErrorCode::out_of_memory));
    }
    catch (const std::exception& error)
    {
        return complain(std::string("internal error: ") + error.what(), cli::kNotSound);
    }
}

} // namespace

int main(int argc, char** argv)
{
#ifdef SIGXFSZ
    std::signal(SIGXFSZ,
                SIG_IGN); // a file beyond the limit is an error that is told, and leaves no half of it
#endif
    int status = taut::cli::kDone;
    const taut::cli::Command command = parse(argc, argv, status);
    return command ? execute(command) : status;
}
