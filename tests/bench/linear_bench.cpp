// taut_linear_bench peers|thesis|precision|residuals|condition|crossover|inventory: the tables and pictures
// of docs/linear.md. Exit status 1 and one sentence when a rival computes something else or a file cannot be
// written; 2 for wrong arguments.

#include "linear_bench.hpp"

#include "conditions.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv)
try
{
    CLI::App app("Conjugate gradients: against others, over formats and devices, and what a digit costs");
    app.require_subcommand(1);
    bench::PeersOptions peers;
    bench::ThesisOptions thesis;
    bench::PrecisionOptions precision;

    CLI::App* command = app.add_subcommand("peers", "7-point Poisson against Eigen, ViennaCL and plain C++");
    command->add_option("--side", peers.side, "unknowns along an edge of the cube")
        ->check(CLI::Range(2, 400));
    command->add_option("--turns", peers.turns, "whole solves of each rival")->check(CLI::Range(1, 1000));
    command->add_option("--only", peers.only, "rivals whose names contain this");
    command->add_option("--csv", peers.csv, "file to write");
    command->callback([&] { bench::run_peers(peers, bench::conditions("taut_linear_bench", argc, argv)); });

    command = app.add_subcommand("thesis", "real matrices in all formats on all devices");
    command->add_option("--tolerance", thesis.tolerance)->check(CLI::PositiveNumber);
    command->add_option("--budget", thesis.budget, "seconds that one solve may take")
        ->check(CLI::PositiveNumber);
    command->add_option("--turns", thesis.turns, "solves of each device")->check(CLI::Range(1, 1000));
    command->add_option("--csv", thesis.csv, "file to write");
    command->callback([&] { bench::run_thesis(thesis, bench::conditions("taut_linear_bench", argc, argv)); });

    struct Part
    {
        const char *name, *help;
        void (*run)(const bench::PrecisionOptions&, const std::string&);
    };
    for (const Part& part :
         {Part{"precision", "time against residual and error", bench::run_precision},
          Part{"residuals", "iterations of the recursive and of the true residual", bench::run_residuals},
          Part{"condition", "error against iteration for prescribed condition numbers", bench::run_condition},
          Part{"crossover", "which format is fastest on which matrix", bench::run_crossover},
          Part{"inventory", "buffers and kernels of an iteration; times nothing", bench::run_inventory}})
    {
        command = app.add_subcommand(part.name, part.help);
        command->add_option("--device", precision.device);
        command->add_option("--csv", precision.csv, "file to write");
        command->add_option("--pictures", precision.pictures, "folder to write diagrams to");
        command->callback([&precision, run = part.run, argc, argv] {
            run(precision, bench::conditions("taut_linear_bench", argc, argv));
        });
    }
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_linear_bench: %s\n", error.what());
    return 1;
}
