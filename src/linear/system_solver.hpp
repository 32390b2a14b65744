#pragma once
// One system on one device: what `solve` does after its checks.

#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/small.hpp"
#include "taut/linear/solve.hpp"

#include <limits>
#include <memory>
#include <vector>

namespace taut::linear {

/// Refers to matrix, b, options and report, which must outlive it.
class SystemSolver
{
public:
    SystemSolver(std::shared_ptr<Device> device, const SparseMatrix& a, std::span<const double> b,
                 std::span<const double> x0, const SolveOptions& options, SolveReport& report);
    std::vector<double> run();

private:
    std::uint32_t report_limit() const;
    void drop_far_start();
    bool small() const;
    void prepare();
    std::vector<double> scaled(std::span<const double> v, int exponent) const;
    CgOutcome solve_once();
    CgOutcome solve_small(std::span<const double> b, std::span<const double> x);
    CgOutcome solve_large(std::span<const double> b, std::span<const double> x);
    void append(const std::vector<float>& part, std::uint32_t first);
    /// Notes the iteration with the smallest residual of a part of the history that begins at `first`.
    void watch(const std::vector<float>& part, std::uint32_t first);
    /// Solves again up to the iteration with the smallest residual, where the last one is far from it: the
    /// same digits come again, so nothing needs to be kept on the device.
    void go_back();
    std::vector<double> read(const BufferPtr& buffer) const;
    std::vector<double> unscaled(std::vector<double> x);
    /// Keeps the better of what there is and `candidate`: by the true residual, and not for a whisker, since
    /// where the iteration ran along a null space a larger x is no better one.
    void take(std::vector<double> candidate);
    /// Says how it ended; false: go on with a smaller tolerance.
    void check_curvature(std::span<const double> direction, CgOutcome& outcome) const;
    bool settle(const CgOutcome& outcome);
    void measure_product();

    std::shared_ptr<Device> device_;
    const SparseMatrix& a_;
    std::span<const double> b_;
    std::vector<double> x_;
    const SolveOptions& options_;
    SolveReport& report_;
    Precision precision_;
    bool pairs_;
    int matrix_exponent_;
    int vector_exponent_;
    bool beyond_double_ = false; ///< of an iterate
    double last_overshoot_ = std::numeric_limits<double>::infinity();
    CgSettings settings_;
    std::vector<double> start_; ///< of the round that had the smallest residual
    std::uint32_t best_iteration_ = 0;
    bool going_back_ = false;
    double best_residual_ = std::numeric_limits<double>::infinity();
    std::shared_ptr<DeviceMatrix> matrix_;
    std::unique_ptr<ConjugateGradient> cg_;
    std::unique_ptr<SmallBatch> batch_;
    std::unique_ptr<Recording> begin_, chunk_;
};

} // namespace taut::linear
