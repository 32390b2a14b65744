#pragma once
// Solves A x = b for a matrix on the host: checks it, scales it, packs it, iterates on a device, and judges
// the answer in fp64. Usable without any physics.

#include "taut/linear/format.hpp"
#include "taut/linear/preconditioner.hpp"
#include "taut/runtime/base/status.hpp"
#include "taut/runtime/device.hpp"

#include <optional>
#include <string>
#include <vector>

namespace taut::linear {

enum class SolvePrecision : std::uint8_t
{
    automatic, ///< float64 where the device has it, else mixed
    float32,   ///< everything in float
    float64,   ///< everything in double
    mixed,     ///< iterates in float; the residual is formed in two floats and x kept in two
};
std::string_view to_string(SolvePrecision); ///< "auto", "float", "double", "mixed"
SolvePrecision solve_precision_from(std::string_view word);

enum class NullSpace : std::uint8_t
{
    none,
    constants, ///< vectors of equal entries: a Neumann Laplacian
    given,     ///< SolveOptions::null_vectors
};

struct SolveOptions
{
    Format format = Format::automatic;
    SolvePrecision precision = SolvePrecision::automatic;
    Preconditioner preconditioner = Preconditioner::jacobi;
    /// Of the true residual |b - A x| / |b|, in (0, 1). b less what held rows give to the others.
    double tolerance = 1e-8;
    std::uint32_t max_iterations = 0; ///< 0: 10 n, at least 1,000
    int chebyshev_degree = 4;
    /// A is singular and b consistent but for its part in the null space: that part is taken out of b and x.
    NullSpace null_space = NullSpace::none;
    std::vector<std::vector<double>> null_vectors; ///< each of n entries; need not be orthogonal
    std::vector<std::uint32_t> held; ///< rows whose x stays exactly at its start (b there is ignored)
    bool one_group = true; ///< systems of at most kSmallRows rows: the whole solve in one work group
    bool keep_history = false;
    bool measure_product = false; ///< time a product by itself, for SolveReport::spmv_gb_per_s
    double asymmetry = 1e-6;      ///< CheckOptions::asymmetry
};

struct SolveReport
{
    Status status = Status::iteration_limit;
    std::string reason; ///< one sentence with the numbers that led to the status
    std::uint32_t n = 0;
    std::uint64_t nnz = 0;
    std::uint32_t iterations = 0;
    std::uint32_t replacements = 0; ///< times that the residual was formed anew
    /// |b - A x| / |b|, true, fp64 on the host; b is what is left of it without its part in the null space.
    double relative_residual = 0;
    double residual_of_given_b = 0; ///< the same with b as it was given: differs where null_part > 0
    double recursive_residual = 0;  ///< what the recurrence believed before it was checked
    double seconds = 0;             ///< iterations only, wall time with all waits
    double setup_seconds = 0;       ///< checks, packing, preconditioner
    double ms_per_iteration = 0;
    double spmv_gb_per_s =
        0; ///< of one product timed by itself, bytes as product_bytes counts; 0: not measured
    std::uint64_t bytes = 0;     ///< device bytes of the matrix
    Format format = Format::csr; ///< the one taken
    std::string format_reason;
    SolvePrecision precision = SolvePrecision::float64;
    Preconditioner preconditioner = Preconditioner::jacobi;
    std::string device;             ///< DeviceInfo::selector
    bool one_group = false;         ///< taken
    double null_part = 0;           ///< share of |b| that the projection took out
    std::vector<std::string> notes; ///< e.g. that A maps constants to zero
    std::vector<float> history;     ///< |r| / |b| of iterations 0, 1, ...
};

struct Solution
{
    std::vector<double> x; ///< the best finite iterate
    SolveReport report;
};

/// Throws what check_system and DeviceMatrix::upload throw, Error{unsupported} for `float64` on a device
/// without it. n = 0 gives an empty x with status zero_right_hand_side.
Solution solve(const std::shared_ptr<Device>&, const SparseMatrix&, std::span<const double> b,
               const SolveOptions& = {}, std::span<const double> x0 = {});

/// Bytes that a product must move at least: the matrix, x once and y once.
std::uint64_t product_bytes(std::uint64_t matrix_bytes, std::uint32_t rows, Precision);

/// |x - exact| / |exact| in the 2-norm.
double forward_error(std::span<const double> x, std::span<const double> exact);

} // namespace taut::linear
