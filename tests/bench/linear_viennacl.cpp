// ViennaCL's conjugate gradients on host memory with OpenMP.

#include "linear_bench.hpp"

#ifdef TAUT_BENCH_VIENNACL

#include <viennacl/compressed_matrix.hpp>
#include <viennacl/linalg/cg.hpp>
#include <viennacl/linalg/jacobi_precond.hpp>
#include <viennacl/linalg/prod.hpp>
#include <viennacl/vector.hpp>

namespace bench {
namespace {

using Matrix = viennacl::compressed_matrix<double>;
using Vector = viennacl::vector<double>;

class WithViennaCl : public Solver
{
public:
    WithViennaCl(const System& system, bool jacobi)
        : jacobi_(jacobi),
          b_(system.a.rows),
          x_(system.a.rows),
          y_(system.a.rows)
    {
        const auto& a = system.a;
        matrix_.set(a.row_start.data(), a.column.data(), a.value.data(), a.rows, a.rows, a.nonzeros());
        viennacl::copy(system.b, b_);
        if (jacobi)
            preconditioner_ = std::make_unique<Preconditioner>(matrix_, viennacl::linalg::jacobi_tag());
    }
    int solve(double tolerance, int limit) override
    {
        const viennacl::linalg::cg_tag tag(tolerance, static_cast<unsigned>(limit));
        x_ = jacobi_ ? viennacl::linalg::solve(matrix_, b_, tag, *preconditioner_)
                     : viennacl::linalg::solve(matrix_, b_, tag);
        return static_cast<int>(tag.iters());
    }
    bool product() override
    {
        y_ = viennacl::linalg::prod(matrix_, b_);
        return true;
    }
    std::vector<double> x() override { return copy_of(x_); }
    std::vector<double> y() override { return copy_of(y_); }

private:
    using Preconditioner = viennacl::linalg::jacobi_precond<Matrix>;
    static std::vector<double> copy_of(const Vector& v)
    {
        std::vector<double> out(v.size());
        viennacl::copy(v, out);
        return out;
    }

    const bool jacobi_;
    Matrix matrix_;
    Vector b_, x_, y_;
    std::unique_ptr<Preconditioner> preconditioner_;
};

} // namespace

std::unique_ptr<Solver> viennacl_solver(const System& system, bool jacobi)
{
    return std::make_unique<WithViennaCl>(system, jacobi);
}

} // namespace bench

#else

namespace bench {

std::unique_ptr<Solver> viennacl_solver(const System&, bool) { return nullptr; }

} // namespace bench

#endif
