// What the recurrence believes and what is true: iterations on the 5-point Poisson of 256 x 256.

#include "linear_device.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cstdio>
#include <random>

namespace bench {

using namespace taut::linear;

namespace {

constexpr std::uint32_t kSide = 256;
constexpr std::uint32_t kMost = 3000;

/// First iteration at which the history is at or below the tolerance; 0: never.
std::uint32_t crossing(const std::vector<float>& history, double tolerance)
{
    for (std::size_t k = 0; k < history.size(); ++k)
        if (history[k] <= tolerance)
            return static_cast<std::uint32_t>(k);
    return 0;
}

/// Entries of b from [-1, 1]: all frequencies, the slow ones too.
System random_system()
{
    System system{"poisson2d", poisson2d(kSide), {}, {}};
    std::mt19937 random(1);
    for (std::uint32_t i = 0; i < system.a.rows; ++i)
        system.b.push_back(static_cast<double>(random()) / 2147483647.5 - 1);
    return system;
}

} // namespace

void run_residuals(const PrecisionOptions& options, const std::string& conditions)
{
    const auto device = taut::Device::open(options.device);
    const System system = random_system();
    std::string rows;
    std::printf(
        "| precision | tolerance | the recurrence is there at | and its x has a true residual of | "
        "`solve` ends at | status | true residual | formed anew |\n|---|---|---|---|---|---|---|---|\n");
    for (const SolvePrecision precision :
         {SolvePrecision::float32, SolvePrecision::mixed, SolvePrecision::float64})
    {
        const auto solver = device_solver(options.device, system, Format::csr, precision);
        const std::vector<float> history = solver->recursion(ConjugateGradient::kHistory - 1);
        for (const double tolerance : {1e-5, 1e-6, 1e-8, 1e-10})
        {
            const std::uint32_t alone = crossing(history, tolerance);
            double believed = 0;
            if (alone > 0)
            {
                solver->recursion(alone);
                believed = relative_residual(system.a, solver->x(), system.b);
            }
            SolveOptions solve_options;
            solve_options.format = Format::csr;
            solve_options.precision = precision;
            solve_options.tolerance = tolerance;
            solve_options.max_iterations = kMost;
            const SolveReport report = solve(device, system.a, system.b, solve_options).report;
            const std::vector<std::string> cells = {
                std::string(to_string(precision)),           taut::shown(tolerance),
                alone > 0 ? std::to_string(alone) : "never", taut::shown(believed, 3),
                std::to_string(report.iterations),           std::string(to_string(report.status)),
                taut::shown(report.relative_residual, 3),    std::to_string(report.replacements)};
            std::printf("|");
            for (const std::string& text : cells)
            {
                std::printf(" %s |", text.c_str());
                rows += (&text == &cells.front() ? "" : ",") + text;
            }
            std::printf("\n");
            rows += '\n';
        }
    }
    if (!options.csv.empty())
        taut::write_file(options.csv,
                         "# " + conditions +
                             "\nprecision,tolerance,recurrence_at,true_residual_there,solve_iterations,"
                             "status,true_residual,formed_anew\n" +
                             rows);
}

} // namespace bench
