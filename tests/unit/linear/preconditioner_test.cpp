#include "taut/linear/preconditioner.hpp"

#include "support/catch.hpp"
#include "support/random.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <limits>

using namespace taut;
using namespace taut::linear;
using taut::conformance::Random;

namespace {

Eigen::MatrixXd dense(const SparseMatrix& a)
{
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(a.rows, a.columns);
    for (const Triplet& t : to_triplets(a))
        m(t.row, t.column) += t.value;
    return m;
}

/// Random, symmetric positive definite and graded: entries of row i have the size of scale^(i / rows).
SparseMatrix random_spd(std::uint32_t n, double scale, std::uint64_t seed)
{
    Random random(seed);
    Eigen::MatrixXd g(n, n);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            g(i, j) = random.chance(0.4) || i == j ? random.uniform(-1, 1) : 0;
    Eigen::MatrixXd a = g * g.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd d(n);
    for (std::uint32_t i = 0; i < n; ++i)
        d[i] = std::pow(scale, double(i) / n);
    a = d.asDiagonal() * a * d.asDiagonal();
    a = 0.5 * (a + a.transpose()).eval();
    std::vector<double> values(std::size_t{n} * n);
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            values[i * n + j] = a(i, j);
    return from_dense(n, n, values);
}

Eigen::Matrix3d block_at(std::span<const double> inverse, std::size_t at)
{
    const double* m = inverse.data() + 6 * at;
    Eigen::Matrix3d block;
    block << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
    return block;
}

std::string message_of(const std::function<void()>& run)
{
    try
    {
        run();
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "nothing was thrown";
}

bool says(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// |I - diag(m) A|_F^2 over rows and columns that are not held.
double distance_from_one(const Eigen::MatrixXd& a, const std::vector<double>& m)
{
    Eigen::MatrixXd e = -a;
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        e.row(i) *= m[static_cast<std::size_t>(i)];
    e.diagonal().array() += 1;
    for (Eigen::Index i = 0; i < a.rows(); ++i)
        if (m[static_cast<std::size_t>(i)] == 0)
        {
            e.row(i).setZero();
            e.col(i).setZero();
        }
    return e.squaredNorm();
}

} // namespace

TEST_CASE("words of preconditioners come back as what they name")
{
    for (const Preconditioner kind :
         {Preconditioner::none, Preconditioner::jacobi, Preconditioner::block_jacobi,
          Preconditioner::chebyshev, Preconditioner::multigrid, Preconditioner::spai0})
        CHECK(preconditioner_from(to_string(kind)) == kind);
    const std::string text = message_of([] { preconditioner_from("ilu"); });
    CHECK(
        text ==
        "\"ilu\" is no preconditioner: there are none, jacobi, block_jacobi, chebyshev, multigrid and spai0");
}

TEST_CASE("jacobi_inverse is one over the diagonal; held rows have 0 and zero rows 1")
{
    const SparseMatrix a = from_triplets(
        5, 5, std::vector<Triplet>{{0, 0, 4}, {0, 1, -1}, {1, 0, -1}, {1, 1, 0.5}, {3, 3, 0}, {4, 4, -7}});
    const std::vector<std::uint32_t> held = {4};
    CHECK(jacobi_inverse(a, held) == std::vector<double>{0.25, 2, 1, 1, 0});
    CHECK(spai0_inverse(a, held)[2] == 1);
    CHECK(spai0_inverse(a, held)[3] == 1);
    CHECK(spai0_inverse(a, held)[4] == 0);
}

TEST_CASE("a row that couples to held rows only counts as a zero row")
{
    const SparseMatrix a =
        from_triplets(3, 3, std::vector<Triplet>{{0, 0, 2}, {0, 1, -1}, {1, 0, -1}, {2, 2, 1}});
    const std::vector<std::uint32_t> held = {0};
    CHECK(jacobi_inverse(a, held) == std::vector<double>{0, 1, 1});
    CHECK(spai0_inverse(a, held) == std::vector<double>{0, 1, 1});
    CHECK(block_jacobi_inverse(a, held) == std::vector<double>{0, 0, 0, 1, 0, 1});
}

TEST_CASE("inverses refuse a diagonal that is not finite and positive, and rows that are not there")
{
    for (const double bad :
         {0.0, -2.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    {
        CAPTURE(bad);
        const SparseMatrix a = from_triplets(
            3, 3, std::vector<Triplet>{{0, 0, 1}, {1, 1, bad}, {1, 2, 0.5}, {2, 1, 0.5}, {2, 2, 1}});
        CHECK(says(message_of([&] { jacobi_inverse(a); }), "row 1 has "));
        CHECK(says(message_of([&] { spai0_inverse(a); }), "row 1 has "));
        CHECK(says(message_of([&] { block_jacobi_inverse(a); }), "row 1 has "));
    }
    const SparseMatrix a = poisson2d(3);
    const std::vector<std::uint32_t> outside = {2, 9};
    CHECK(says(message_of([&] { jacobi_inverse(a, outside); }), "held row 9 "));
    CHECK(says(message_of([&] { spai0_inverse(a, outside); }), "held row 9 "));
    CHECK(says(message_of([&] { block_jacobi_inverse(a, outside); }), "held row 9 "));
}

TEST_CASE("inverses of entries near the ends of the range are finite and positive")
{
    for (const double size : {5e-324, 1e-300, 1e300})
    {
        const SparseMatrix a =
            from_triplets(3, 3, std::vector<Triplet>{{0, 0, size}, {1, 1, size}, {2, 2, size}});
        for (const std::vector<double>& inverse : {jacobi_inverse(a), spai0_inverse(a)})
            for (const double value : inverse)
                CHECK((value > 0 && std::isfinite(value)));
    }
    const SparseMatrix a =
        from_triplets(2, 2, std::vector<Triplet>{{0, 0, 4e300}, {0, 1, 2e300}, {1, 0, 2e300}, {1, 1, 4e300}});
    CHECK(spai0_inverse(a)[0] == Approx(2e-301).epsilon(1e-15)); // 4 / (16 + 4)
}

TEST_CASE("spai0_inverse is the diagonal nearest to the inverse in the Frobenius norm")
{
    const std::vector<std::uint32_t> held = {3, 4};
    const bool holding = GENERATE(false, true);
    const SparseMatrix a = random_spd(12, 100, 7);
    const Eigen::MatrixXd full = dense(a);
    const std::vector<double> m = spai0_inverse(a, holding ? held : std::vector<std::uint32_t>{});
    const double least = distance_from_one(full, m);
    for (std::size_t i = 0; i < m.size(); ++i)
    {
        CAPTURE(i, holding);
        if (holding && (i == 3 || i == 4))
        {
            CHECK(m[i] == 0);
            continue;
        }
        for (const double factor : {0.99, 1.01}) // a parabola in each entry: neighbours tell
        {
            std::vector<double> other = m;
            other[i] *= factor;
            CHECK(distance_from_one(full, other) > least);
        }
        double squares = 0;
        for (std::size_t j = 0; j < m.size(); ++j)
        {
            const double v = full(Eigen::Index(i), Eigen::Index(j));
            squares += holding && (j == 3 || j == 4) ? 0 : v * v;
        }
        CHECK(m[i] == Approx(full(Eigen::Index(i), Eigen::Index(i)) / squares).epsilon(1e-14));
    }
}

TEST_CASE("block_jacobi_inverse agrees with Eigen's inverse of each block")
{
    const SparseMatrix a = random_spd(30, 1e4, 11);
    const std::vector<double> inverse = block_jacobi_inverse(a);
    REQUIRE(inverse.size() == 60);
    const Eigen::MatrixXd full = dense(a);
    for (Eigen::Index at = 0; at < 10; ++at)
    {
        const Eigen::Matrix3d block = full.block<3, 3>(3 * at, 3 * at);
        const Eigen::Matrix3d product = block_at(inverse, std::size_t(at)) * block;
        const double condition = block.norm() * block.inverse().norm();
        CHECK((product - Eigen::Matrix3d::Identity()).norm() <= 8 * 0x1p-53 * condition);
    }
}

TEST_CASE("block_jacobi_inverse inverts what is left of a block without its held rows")
{
    const SparseMatrix a = random_spd(9, 10, 5);
    const std::vector<std::uint32_t> held = {1, 3, 5, 6, 7, 8};
    const std::vector<double> inverse = block_jacobi_inverse(a, held);
    const Eigen::MatrixXd full = dense(a);
    Eigen::Matrix2d left;
    left << full(0, 0), full(0, 2), full(2, 0), full(2, 2);
    const Eigen::Matrix2d expected = left.inverse();
    CHECK(inverse[0] == Approx(expected(0, 0)).epsilon(1e-13));
    CHECK(inverse[2] == Approx(expected(0, 1)).epsilon(1e-13));
    CHECK(inverse[5] == Approx(expected(1, 1)).epsilon(1e-13));
    CHECK((inverse[1] == 0 && inverse[3] == 0 && inverse[4] == 0));
    CHECK(inverse[6 + 3] == Approx(1 / full(4, 4)).epsilon(1e-14));
    for (const int k : {0, 1, 2, 4, 5})
        CHECK(inverse[std::size_t(6 + k)] == 0);
    for (std::size_t k = 12; k < 18; ++k)
        CHECK(inverse[k] == 0);
}

TEST_CASE("block_jacobi_inverse refuses sizes that are no multiple of 3 and blocks that are not definite")
{
    CHECK(says(message_of([] { block_jacobi_inverse(poisson2d(4)); }), "16"));
    const double off = GENERATE(1.0, 2.0, -1.0); // singular, indefinite, singular
    const std::vector<Triplet> entries = {{0, 0, 1},   {1, 1, 1}, {2, 2, 1},   {3, 3, 1},
                                          {3, 5, off}, {4, 4, 1}, {5, 3, off}, {5, 5, 1}};
    const SparseMatrix a = from_triplets(6, 6, entries);
    CHECK(says(message_of([&] { block_jacobi_inverse(a); }), "block row 1 (rows 3 to 5"));
}

TEST_CASE("the rounded inverse of a nearly singular block is positive definite")
{
    Random random(3);
    for (int turn = 0; turn < 200; ++turn)
    {
        const double small = std::pow(10.0, random.uniform(-13, -3));
        Eigen::Matrix3d g;
        for (int k = 0; k < 9; ++k)
            g(k / 3, k % 3) = random.uniform(-1, 1);
        const Eigen::Matrix3d q = g.householderQr().householderQ();
        const Eigen::Vector3d scale(1, std::pow(10.0, random.uniform(-2, 2)), 1);
        const Eigen::Matrix3d block = scale.asDiagonal() * q * Eigen::Vector3d(1, small, small).asDiagonal() *
                                      q.transpose() * scale.asDiagonal();
        std::vector<double> values(9);
        for (int k = 0; k < 9; ++k)
            values[std::size_t(k)] = 0.5 * (block(k / 3, k % 3) + block(k % 3, k / 3));
        std::vector<double> inverse = block_jacobi_inverse(from_dense(3, 3, values), {}, 0x1p-24);
        for (double& v : inverse)
            v = static_cast<float>(v);
        const Eigen::Matrix3d rounded = block_at(inverse, 0);
        const Eigen::Vector3d root = rounded.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::Matrix3d scaled = root.asDiagonal() * rounded * root.asDiagonal();
        CAPTURE(small, turn);
        CHECK(scaled.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > 0);
    }
}
