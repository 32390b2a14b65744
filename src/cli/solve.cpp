// taut solve: a sparse linear system from Matrix Market files.

#include "taut/linear/solve.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/device_option.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/solve_result.hpp"
#include "taut/linear/check.hpp"
#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <filesystem>
#include <iostream>
#include <limits>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct SolveCommand
{
    std::string matrix, right_hand_side, device, out, history;
    std::string format = "auto", precision = "auto", preconditioner = "jacobi", null_space = "none";
    double tolerance = 1e-8;
    std::uint32_t max_iterations = 0; ///< 0: not given
    int chebyshev_degree = 4;
    bool json = false, no_one_group = false;
};

linear::SolveOptions solve_options(const SolveCommand& command)
{
    linear::SolveOptions options;
    options.format = linear::format_from(command.format);
    options.precision = linear::solve_precision_from(command.precision);
    options.preconditioner = linear::preconditioner_from(command.preconditioner);
    options.null_space =
        command.null_space == "none" ? linear::NullSpace::none : linear::NullSpace::constants;
    options.tolerance = command.tolerance;
    options.max_iterations = command.max_iterations;
    options.chebyshev_degree = command.chebyshev_degree;
    options.one_group = !command.no_one_group;
    options.keep_history = !command.history.empty();
    options.measure_product = true;
    return options;
}

/// Whether two paths name one file, also where neither is there yet.
bool same_file(const std::string& a, const std::string& b)
{
    std::error_code error;
    if (fs::equivalent(a, b, error))
        return true;
    const fs::path first = fs::weakly_canonical(fs::absolute(a, error), error);
    const fs::path second = fs::weakly_canonical(fs::absolute(b, error), error);
    return !first.empty() && first == second;
}

/// Before anything is read: no file is to be written over another one.
void check_names(const SolveCommand& command)
{
    const auto check = [&](const std::string& file, const char* option) {
        for (const std::string& input : {command.matrix, command.right_hand_side})
            if (!file.empty() && !input.empty() && same_file(input, file))
                throw Error(ErrorCode::bad_input, std::string(option) + " names " + file +
                                                      ", which is an input; choose another name.");
        std::error_code error;
        if (fs::is_directory(file, error))
            throw Error(ErrorCode::bad_input,
                        std::string(option) + " names the folder " + file + "; name a file.");
    };
    check(command.out, "--out");
    check(command.history, "--history");
    if (!command.out.empty() && !command.history.empty() && same_file(command.out, command.history))
        throw Error(ErrorCode::bad_input, "--out and --history both name " + command.history +
                                              "; x and its history need a file each, choose another name.");
}

/// Before minutes of work: there is a folder for the file, and it takes files.
void prepare_output(const std::string& file, const char* option)
{
    if (file.empty())
        return;
    if (fs::path(file).has_parent_path())
        make_folder(fs::path(file).parent_path(), option);
    check_writable(file);
}

void take_mean_out(std::vector<double>& x)
{
    double mean = 0;
    for (const double v : x)
        mean += v / double(x.size());
    for (double& v : x)
        v -= mean;
}

/// The known solution: entries of all signs between -1 and 1 that no null space of a usual matrix holds.
/// Multiples of 2^-31, the same on every machine.
std::vector<double> known_solution(std::uint32_t n)
{
    std::vector<double> x(n);
    for (std::uint32_t i = 0; i < n; ++i)
        x[i] = double(2654435761u * (i + 1)) * 0x1p-31 - 1; // Knuth's multiplicative hash, modulo 2^32
    return x;
}

/// Of a matrix that maps constants to zero only what is not constant can be found again.
double error_of(const linear::SparseMatrix& a, std::vector<double> x, std::vector<double> exact)
{
    if (linear::maps_constants_to_zero(a))
    {
        take_mean_out(x);
        take_mean_out(exact);
    }
    return linear::forward_error(x, exact);
}

/// A x, every entry rounded once.
std::vector<double> exact_product(const linear::SparseMatrix& a, const std::vector<double>& x)
{
    std::vector<double> zero(a.rows, 0.0), b(a.rows);
    linear::residual(a, x, zero, b);
    for (double& v : b)
        v = 0 - v; // no -0
    return b;
}

std::string place(const linear::Triplet& entry)
{
    return "row " + std::to_string(entry.row + 1) + ", column " + std::to_string(entry.column + 1);
}

void add_notes(const linear::BuildNotes& found, std::vector<std::string>& notes)
{
    if (found.duplicates > 0)
        notes.push_back(counted(found.duplicates, "entry was", "entries were") +
                        " added to an earlier one of the same place, first at " +
                        place(found.first_duplicate) + " (counted from 1)");
    if (found.explicit_zeros > 0)
        notes.push_back(counted(found.explicit_zeros, "stored entry is", "stored entries are") + " zero");
}

/// What solve() finds wrong with a system is wrong with these files.
linear::Solution solve_files(const SolveCommand& command, const std::shared_ptr<Device>& device,
                             const linear::SparseMatrix& a, const std::vector<double>& b,
                             const linear::SolveOptions& options)
{
    try
    {
        return linear::solve(device, a, b, options);
    }
    catch (const Error& error)
    {
        const bool both = !command.right_hand_side.empty();
        throw Error(error.code(),
                    command.matrix + (both ? ", " + command.right_hand_side : "") + ": " + error.what());
    }
}

int solve(const SolveCommand& command)
{
    const linear::SolveOptions options = solve_options(command);
    check_names(command);
    const linear::MatrixFile file = linear::read_matrix_market(command.matrix);
    const bool manufactured = command.right_hand_side.empty();
    const std::vector<double> exact =
        manufactured ? known_solution(file.matrix.columns) : std::vector<double>();
    const std::vector<double> b =
        manufactured ? exact_product(file.matrix, exact) : linear::read_vector(command.right_hand_side);
    const auto device = open_device(command.device);
    prepare_output(command.out, "--out");
    prepare_output(command.history, "--history");
    linear::Solution solution = solve_files(command, device, file.matrix, b, options);
    SolveResult result;
    result.matrix = command.matrix;
    result.right_hand_side = command.right_hand_side;
    result.tolerance = command.tolerance;
    result.report = std::move(solution.report);
    add_notes(file.notes, result.report.notes);
    if (manufactured)
        result.forward_error = error_of(file.matrix, solution.x, exact);
    if (!command.out.empty())
    {
        linear::write_vector(command.out, solution.x,
                             "x of " + command.matrix + "\n" + std::string(to_string(result.report.status)) +
                                 ": " + result.report.reason);
        result.written.push_back(command.out);
    }
    if (!command.history.empty())
    {
        write_file(command.history, history_csv(result.report));
        result.written.push_back(command.history);
    }
    std::cout << (command.json ? to_text(to_json(result)) : summary(result));
    return exit_status(result.report.status);
}

} // namespace

void add_solve(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand("solve", "Solve a sparse symmetric positive definite system");
    const auto options = std::make_shared<SolveCommand>();
    command->add_option("matrix", options->matrix, "A: Matrix Market file")->required();
    command->add_option("right-hand-side", options->right_hand_side,
                        "b: Matrix Market file of one column (default: A x of a known x)");
    add_device_option(*command, options->device);
    command
        ->add_option("--format", options->format, "auto, dense, coo, csr, ell, sell, bcsr3 (default: auto)")
        ->check(CLI::IsMember({"auto", "dense", "coo", "csr", "ell", "sell", "bcsr3"}));
    command->add_option("--precision", options->precision, "auto, float, double, mixed (default: auto)")
        ->check(CLI::IsMember({"auto", "float", "double", "mixed"}));
    command
        ->add_option("--preconditioner", options->preconditioner,
                     "none, jacobi, block_jacobi, chebyshev, multigrid, spai0 (default: jacobi)")
        ->check(CLI::IsMember({"none", "jacobi", "block_jacobi", "chebyshev", "multigrid", "spai0"}));
    command
        ->add_option("--chebyshev-degree", options->chebyshev_degree,
                     "Of the polynomial of --preconditioner chebyshev, 1 to 16 (default: 4)")
        ->check(whole_number(1, 16));
    command
        ->add_option("--tolerance", options->tolerance,
                     "Of the true |b - A x| / |b|, between 0 and 1 (default: 1e-8)")
        ->check(number_between(0, 1, Ends::open));
    command
        ->add_option("--max-iterations", options->max_iterations,
                     "At most, 1 or more (default: ten times the unknowns, at least 1,000)")
        ->check(whole_number(1));
    command
        ->add_option("--null-space", options->null_space, "none, or constants: A is singular (default: none)")
        ->check(CLI::IsMember({"none", "constants"}));
    command->add_flag("--no-one-group", options->no_one_group,
                      "Solve a small system as a large one: not by one work group in one dispatch");
    command->add_option("--history", options->history, "CSV file for the residual of every iteration");
    command->add_option("--out", options->out, "Matrix Market file for x");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options] { chosen = [options] { return solve(*options); }; });
}

} // namespace taut::cli
