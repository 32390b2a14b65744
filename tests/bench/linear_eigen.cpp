// Eigen's conjugate gradients. Row-major and Lower|Upper: what Eigen shares among OpenMP threads.

// This file is compiled with other vector flags than the library, which has Eigen code too: its own namespace
// keeps the linker from mixing the two.
#define Eigen EigenNative
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include "linear_bench.hpp"

#include <algorithm>

namespace bench {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

class WithEigen : public Solver
{
public:
    WithEigen(const System& system, int threads) : threads_(threads)
    {
        const auto& a = system.a;
        matrix_.resize(static_cast<int>(a.rows), static_cast<int>(a.rows));
        matrix_.resizeNonZeros(static_cast<int>(a.nonzeros()));
        std::copy(a.row_start.begin(), a.row_start.end(), matrix_.outerIndexPtr());
        std::copy(a.column.begin(), a.column.end(), matrix_.innerIndexPtr());
        std::copy(a.value.begin(), a.value.end(), matrix_.valuePtr());
        b_ = Vector::Map(system.b.data(), static_cast<int>(a.rows));
        y_ = Vector::Zero(b_.size());
        solver_.compute(matrix_);
    }
    int solve(double tolerance, int limit) override
    {
        Eigen::setNbThreads(threads_);
        solver_.setTolerance(tolerance);
        solver_.setMaxIterations(limit);
        x_ = solver_.solve(b_);
        return static_cast<int>(solver_.iterations());
    }
    bool product() override
    {
        Eigen::setNbThreads(threads_);
        y_.noalias() = matrix_ * b_;
        return true;
    }
    std::vector<double> x() override { return {x_.begin(), x_.end()}; }
    std::vector<double> y() override { return {y_.begin(), y_.end()}; }

private:
    const int threads_;
    Matrix matrix_;
    Vector b_, x_, y_;
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, Eigen::DiagonalPreconditioner<double>>
        solver_;
};

} // namespace

std::unique_ptr<Solver> eigen_solver(const System& system, int threads)
{
#ifndef _OPENMP
    if (threads > 1)
        return nullptr;
#endif
    return std::make_unique<WithEigen>(system, threads);
}

std::string peer_versions()
{
    std::string text = "Eigen " + std::to_string(EIGEN_WORLD_VERSION) + "." +
                       std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION);
#ifdef TAUT_BENCH_VIENNACL
    text += "; ViennaCL";
#else
    text += "; no ViennaCL (libviennacl-dev)";
#endif
#ifdef _OPENMP
    text += "; OpenMP " + std::to_string(_OPENMP);
#else
    text += "; no OpenMP";
#endif
    return text + "; peers built with -O3 -march=native -ffp-contract=fast";
}

} // namespace bench
