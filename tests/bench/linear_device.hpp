#pragma once
// Taut's own conjugate gradients as a rival.

#include "linear_bench.hpp"

#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/solve.hpp"

namespace bench {

class DeviceSolver : public Solver
{
public:
    DeviceSolver(std::shared_ptr<taut::Device> device, std::shared_ptr<const taut::linear::Operator> op,
                 const taut::linear::Preconditioning& preconditioning, const System& system, bool pairs);

    int solve(double tolerance, int limit) override;
    std::vector<double> x() override;
    bool product() override;
    std::vector<double> y() override;

    /// Iterates by the recurrence alone, never forming the residual before the last iteration (at most
    /// ConjugateGradient::kHistory - 1): |r| / |b| of iterations 0, 1, ...
    std::vector<float> recursion(std::uint32_t iterations);

private:
    void run(const taut::linear::CgSettings& settings);

    std::shared_ptr<taut::Device> device_;
    std::shared_ptr<const taut::linear::Operator> operator_;
    const bool pairs_;
    const std::uint32_t rows_;
    taut::linear::ConjugateGradient cg_;
    std::unique_ptr<taut::Recording> begin_, chunk_, product_;
    taut::BufferPtr right_, y_;
    std::vector<double> zero_;
    taut::linear::CgOutcome outcome_;
};

/// A matrix without scaling, with Jacobi or, where not `jacobi`, none. Values of `system` must not need
/// scaling.
std::unique_ptr<DeviceSolver> device_solver(const std::string& selector, const System& system,
                                            taut::linear::Format format,
                                            taut::linear::SolvePrecision precision, bool jacobi = true);

/// The 7-point Laplacian of poisson3d(side) without a matrix, in double, without a preconditioner (its
/// diagonal is constant: Jacobi would change no iterate).
std::unique_ptr<DeviceSolver> matrix_free_solver(const std::string& selector, const System& system,
                                                 std::uint32_t side);

} // namespace bench
