#pragma once
// Conjugate gradients against others: what the parts of taut_linear_bench share.

#include "bench.hpp"

#include "taut/linear/sparse.hpp"
#include "taut/runtime/base/csv.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace bench {

/// A x = b with a known solution.
struct System
{
    std::string name;
    taut::linear::SparseMatrix a;
    std::vector<double> b, exact;
};

/// Entries of `exact` are drawn from [-1, 1] with a fixed seed; b = A exact, each entry rounded once.
System manufactured(std::string name, taut::linear::SparseMatrix a);

/// One who solves A x = b from x = 0 by conjugate gradients. Set-up is done by its maker and not timed.
class Solver
{
public:
    virtual ~Solver() = default;
    /// Until |r| <= tolerance |b| by the solver's own reckoning, or the limit. Returns the iterations taken.
    virtual int solve(double tolerance, int limit) = 0;
    /// x of the last solve.
    virtual std::vector<double> x() = 0;
    /// y = A b, for those that can do it alone; false: cannot.
    virtual bool product() { return false; }
    /// y of the last product.
    virtual std::vector<double> y() { return {}; }
};

// Rivals, compiled for this very machine (-O3 -march=native). `system` must outlive them.

/// Two or more threads of plain C++, three loops an iteration, diagonal preconditioner.
std::unique_ptr<Solver> plain_solver(const System& system, int threads);
/// Eigen::ConjugateGradient with a diagonal preconditioner. Null where built without OpenMP and threads > 1.
std::unique_ptr<Solver> eigen_solver(const System& system, int threads);
/// ViennaCL's OpenMP backend; its own fused iteration where `jacobi` is false. Null where built without.
std::unique_ptr<Solver> viennacl_solver(const System& system, bool jacobi);
std::string peer_versions();

/// memcpy of `bytes` bytes by `threads` threads, a share each.
void parallel_copy(void* to, const void* from, std::size_t bytes, int threads);

// The subcommands. `csv` may be empty: then only the table is printed.

struct PeersOptions
{
    std::uint32_t side = 100; ///< of the cube
    int turns = 5;
    double tolerance = 1e-8;
    std::string only; ///< rivals whose names contain it
    std::string csv;
};
void run_peers(const PeersOptions& options, const std::string& conditions);

struct ThesisOptions
{
    double tolerance = 1e-6;
    double budget = 0.5; ///< seconds that one solve may take; iterations are capped to fit
    int turns = 3;
    std::string csv;
};
void run_thesis(const ThesisOptions& options, const std::string& conditions);

struct PrecisionOptions
{
    std::string device = "cpu";
    std::string csv;
    std::filesystem::path pictures; ///< empty: none
};
void run_precision(const PrecisionOptions& options, const std::string& conditions);
/// Iterations of the recursive and of the true residual on the 5-point Poisson of 256 x 256.
void run_residuals(const PrecisionOptions& options, const std::string& conditions);

/// Error against iteration for prescribed condition numbers.
void run_condition(const PrecisionOptions& options, const std::string& conditions);
/// Which format is fastest on the matrices of linear_matrices.hpp.
void run_crossover(const PrecisionOptions& options, const std::string& conditions);
/// Buffers and kernels of one iteration in every format, as the recording has them. Times nothing.
void run_inventory(const PrecisionOptions& options, const std::string& conditions);

/// Folder of the real matrices: $TAUT_DATA/matrices, else ../shared/data/matrices beside the source tree.
/// Empty, and a line on standard error, where there is none.
std::filesystem::path matrix_folder();

} // namespace bench
