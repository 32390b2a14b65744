// What the tables of condition numbers rest on (tests/support/spectrum.hpp), against Eigen's dense solver.

#include "support/spectrum.hpp"

#include "support/catch.hpp"
#include "support/symmetric.hpp"

using namespace taut::linear;
using namespace taut::test;

namespace {

Eigen::MatrixXd dense(const SparseMatrix& a)
{
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(a.rows, a.columns);
    for (const Triplet& entry : to_triplets(a))
        out(entry.row, entry.column) = entry.value;
    return out;
}

} // namespace

TEST_CASE("a prescribed matrix is symmetric and has the eigenvalues asked for", "[spectrum]")
{
    const std::uint32_t rows = 61;
    const double condition = GENERATE(10.0, 1e6);
    const Eigen::MatrixXd a = dense(prescribed_matrix(rows, condition));
    CHECK((a - a.transpose()).cwiseAbs().maxCoeff() == 0);
    CHECK(a.diagonal().maxCoeff() < 0.99); // turned, no longer the diagonal matrix of its eigenvalues
    const Eigen::VectorXd found = taut::symmetric_eigenvalues(a);
    for (std::uint32_t i = 0; i < rows; ++i)
        CHECK(std::abs(found[rows - 1 - i] - std::pow(condition, -double(i) / (rows - 1))) < 1e-14);
}

TEST_CASE("condition numbers are Eigen's, of a matrix and of the one scaled by its diagonal", "[spectrum]")
{
    std::vector<Triplet> entries = to_triplets(poisson2d(9));
    for (Triplet& entry : entries) // S A S with S from 1 to 10
        entry.value *= std::pow(10, (entry.row + entry.column) / 80.0);
    const SparseMatrix a = from_triplets(81, 81, entries);
    const Eigen::VectorXd plain = taut::symmetric_eigenvalues(dense(a)),
                          scaled = taut::symmetric_eigenvalues(dense(poisson2d(9)));
    CHECK(condition_number(a, false) == Approx(plain[80] / plain[0]).epsilon(1e-9));
    CHECK(condition_number(a, true) == Approx(scaled[80] / scaled[0]).epsilon(1e-9));
}
