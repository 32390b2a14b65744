// Which format is fastest on which matrix: by size and share of places filled, by how unlike the rows are,
// and on the matrices that the simulator forms. Every format runs the same iterations in turns.

#include "linear_device.hpp"
#include "linear_matrices.hpp"

#include "support/spectrum.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace bench {

using namespace taut::linear;

namespace {

constexpr int kTurns = 15;
constexpr double kTolerance = 1e-8;
constexpr int kMostIterations = 20000;
constexpr std::uint64_t kMostPlaces = 1u << 23; ///< of dense and ell: more takes gigabytes or minutes
constexpr Format kFormats[] = {Format::csr, Format::dense, Format::coo,
                               Format::ell, Format::sell,  Format::bcsr3};

bool too_large(Format format, const RowStatistics& s)
{
    const std::uint64_t row = format == Format::dense ? s.rows : format == Format::ell ? s.longest : 0;
    return row * s.rows > kMostPlaces;
}

/// What one format made of a matrix.
struct Entry
{
    Format format;
    std::unique_ptr<DeviceSolver> solver;
    int iterations = 0;
    double ms = 0; ///< an iteration, the least of all turns
};

struct Line
{
    System system;
    std::vector<Entry> entries; ///< csr first
    double error = 0;           ///< the largest |x - x*| / |x*|
};

/// Throws std::runtime_error where a format does not solve the system.
Line race(const NamedMatrix& matrix, const std::string& device)
{
    std::fprintf(stderr, "%s\n", matrix.name.c_str());
    Line line{manufactured(matrix.name, matrix.make()), {}, 0};
    const System& system = line.system;
    const RowStatistics statistics = row_statistics(system.a);
    for (const Format format : kFormats)
        if (!too_large(format, statistics) && (format != Format::bcsr3 || system.a.rows % 3 == 0))
            line.entries.push_back({format, device_solver(device, system, format, SolvePrecision::float64)});
    std::vector<Rival> rivals;
    for (Entry& entry : line.entries)
        rivals.push_back(
            {"", [&entry] { entry.iterations = entry.solver->solve(kTolerance, kMostIterations); }});
    take_turns(rivals, kTurns, 1);
    for (std::size_t k = 0; k < rivals.size(); ++k)
    {
        Entry& entry = line.entries[k];
        const std::vector<double> x = entry.solver->x();
        if (!(relative_residual(system.a, x, system.b) <= kTolerance))
            throw std::runtime_error(system.name + " is not solved in " +
                                     std::string(to_string(entry.format)));
        line.error = std::max(line.error, forward_error(x, system.exact));
        entry.ms = rivals[k].best() / entry.iterations;
    }
    return line;
}

/// A row of the table.
std::vector<std::string> cells(const Line& line)
{
    const SparseMatrix& a = line.system.a;
    const RowStatistics s = row_statistics(a);
    std::vector<std::string> out = {line.system.name,
                                    std::to_string(s.rows),
                                    taut::shown(s.mean, 3),
                                    std::to_string(s.longest),
                                    taut::shown(taut::test::condition_number(a, false), 2),
                                    taut::shown(taut::test::condition_number(a, true), 2),
                                    std::to_string(line.entries[0].iterations)};
    const Entry* fastest = &line.entries[0];
    for (const Format format : kFormats)
    {
        std::string cell;
        for (const Entry& entry : line.entries)
            if (entry.format == format)
            {
                cell = format == Format::csr ? taut::shown(entry.ms, 3)
                                             : taut::shown(entry.ms / line.entries[0].ms, 2);
                fastest = entry.ms < fastest->ms ? &entry : fastest;
            }
        out.push_back(cell);
    }
    out.emplace_back(to_string(fastest->format));
    out.emplace_back(to_string(choose_format(s, false).format));
    out.push_back(taut::shown(line.error, 1));
    return out;
}

const std::vector<std::string>& head()
{
    static const std::vector<std::string> all = {
        "matrix", "rows", "mean row", "longest", "k",     "k, Jacobi", "iterations", "csr, ms",
        "dense",  "coo",  "ell",      "sell",    "bcsr3", "fastest",   "auto",       "error"};
    return all;
}

void put(const std::vector<std::string>& row, std::string& csv)
{
    std::printf("|");
    for (const std::string& cell : row)
    {
        std::printf(" %s |", cell.c_str());
        csv += taut::csv_cell(cell) + (&cell == &row.back() ? '\n' : ',');
    }
    std::printf("\n");
}

} // namespace

void run_crossover(const PrecisionOptions& options, const std::string& conditions)
{
    std::string csv = "# " + conditions + '\n';
    put(head(), csv);
    std::printf("|---|");
    for (std::size_t k = 1; k < head().size(); ++k)
        std::printf("---:|");
    std::printf("\n");
    for (const NamedMatrix& matrix : crossover_matrices())
        put(cells(race(matrix, options.device)), csv);
    if (!options.csv.empty())
        taut::write_file(options.csv, csv);
}

} // namespace bench
