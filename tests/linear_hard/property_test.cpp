// Several hundred random systems, good and bad: never a false "converged", no NaN, a word and a reason.
//
// TAUT_SEED=7 runs other systems than the usual, TAUT_CASES=5000 more of them; TAUT_FIRST=69
// begins there.

#include "linear_hard/cases.hpp"
#include "support/symmetric.hpp"

#include <Eigen/Dense>

#include <array>

using namespace taut;
using namespace taut::linear;

namespace {

std::uint64_t number_of(const char* variable, std::uint64_t otherwise)
{
    const char* text = std::getenv(variable);
    return text != nullptr && *text ? std::strtoull(text, nullptr, 10) : otherwise;
}

enum class Kind
{
    dominant,     ///< positive definite by its diagonal: must be solved
    gram,         ///< B B^T + small: near-singular
    laplacian,    ///< a path's, or a grid's
    semidefinite, ///< B B^T of low rank, b in or out of its range
    indefinite,   ///< positive diagonal, negative eigenvalues
    scaled,       ///< D A D with D over many decades
    hostile,      ///< values that float holds badly: 1 + 1e-12, 1e-39, 1e37
    arbitrary,    ///< symmetric, anything
    count,
};

struct System
{
    Kind kind = Kind::dominant;
    SparseMatrix a;
    Vector b, x0;
    SolveOptions options;
    std::string device;
};

double decades(Random& random, double low, double high) { return std::pow(10, random.uniform(low, high)); }

/// Off-diagonal pairs of a random pattern.
std::vector<Triplet> pairs(Random& random, std::uint32_t n)
{
    std::vector<Triplet> t;
    const std::uint32_t count = n * (1 + random.below(n < 60 ? n : 12)) / 2;
    const bool hub = random.chance(0.1);
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const std::uint32_t i = hub && random.chance(0.5) ? 0 : random.below(n), j = random.below(n);
        if (i != j)
            t.push_back({i, j, random.uniform(-1, 1)});
    }
    return t;
}

SparseMatrix symmetric(std::uint32_t n, const std::vector<Triplet>& upper, const Vector& diagonal)
{
    std::vector<Triplet> t;
    for (const Triplet& e : upper)
    {
        t.push_back(e);
        t.push_back({e.column, e.row, e.value});
    }
    for (std::uint32_t i = 0; i < n; ++i)
        t.push_back({i, i, diagonal[i]});
    // Duplicates are summed in another order above than below the diagonal: make mirrors equal again.
    SparseMatrix a = from_triplets(n, n, t);
    std::vector<Triplet> once;
    for (const Triplet& e : to_triplets(a))
    {
        if (e.row < e.column)
            once.push_back({e.column, e.row, e.value});
        if (e.row <= e.column)
            once.push_back(e);
    }
    return from_triplets(n, n, once);
}

Vector diagonal_of(Random& random, std::uint32_t n, const std::vector<Triplet>& upper, double share,
                   double least)
{
    Vector sums(n, 0.0);
    for (const Triplet& e : upper)
    {
        sums[e.row] += std::abs(e.value);
        sums[e.column] += std::abs(e.value);
    }
    for (double& sum : sums)
        sum = sum * share + least * random.uniform(0.5, 1);
    return sums;
}

/// B B^T + shift with B of n x rank.
SparseMatrix gram(Random& random, std::uint32_t n, std::uint32_t rank, double shift)
{
    Eigen::MatrixXd b(n, rank);
    for (Eigen::Index k = 0; k < b.size(); ++k)
        b.data()[k] = random.chance(0.3) ? random.uniform(-1, 1) : 0;
    Eigen::MatrixXd a = b * b.transpose();
    a = ((a + a.transpose()) / 2).eval();
    for (std::uint32_t i = 0; i < n; ++i)
        a(i, i) += shift + (a(i, i) == 0 ? 1 : 0);
    return from_dense(n, n, std::span(a.data(), std::size_t(a.size())));
}

SparseMatrix matrix_of(Random& random, Kind kind, std::uint32_t n)
{
    const std::vector<Triplet> upper = pairs(random, n);
    const auto dominant = [&] { return symmetric(n, upper, diagonal_of(random, n, upper, 1.05, 0.1)); };
    switch (kind)
    {
    case Kind::gram: return gram(random, std::min(n, 150u), std::min(n, 150u), decades(random, -14, -2));
    case Kind::laplacian: return random.chance(0.5) ? neumann(std::max(n, 2u)) : poisson2d(1 + n / 20);
    case Kind::semidefinite: return gram(random, std::min(n, 150u), std::max(1u, std::min(n, 150u) / 2), 0);
    case Kind::indefinite:
        return symmetric(n, upper, diagonal_of(random, n, upper, random.uniform(0.1, 0.9), 0.1));
    case Kind::scaled:
    {
        Vector d(n);
        const double width = random.uniform(0, random.chance(0.5) ? 4 : 25);
        for (double& entry : d)
            entry = decades(random, -width, width);
        const SparseMatrix a = congruent(dominant(), d);
        return symmetric(
            n,
            [&] {
                std::vector<Triplet> t;
                for (const Triplet& e : to_triplets(a))
                    if (e.row < e.column)
                        t.push_back(e);
                return t;
            }(),
            [&] {
                Vector v(n, 0.0);
                for (const Triplet& e : to_triplets(a))
                    if (e.row == e.column)
                        v[e.row] = e.value;
                return v;
            }());
    }
    case Kind::hostile:
    {
        static constexpr std::array kValues = {1 + 1e-12, 1e-39,         1e-46,  1e37,
                                               -1e37,     0x1.fffffffp0, 1e-300, -1.0};
        std::vector<Triplet> t = upper;
        for (Triplet& e : t)
            e.value = random.chance(0.3) ? kValues[random.below(kValues.size())] : e.value;
        return symmetric(n, t, diagonal_of(random, n, t, random.chance(0.7) ? 1.1 : 0.8, 1e-3));
    }
    case Kind::arbitrary:
    {
        Vector d = random_vector(random, n, random.chance(0.5) ? -1 : 0, 3);
        return symmetric(n, upper, d);
    }
    default: return dominant();
    }
}

Vector right_side(Random& random, const SparseMatrix& a)
{
    Vector b = random_vector(random, a.rows);
    switch (random.below(7))
    {
    case 0: return b;
    case 1:
        for (double& entry : b)
            entry *= decades(random, -30, 30);
        return b;
    case 2: return scaled(b, random.chance(0.5) ? 1e-200 : 1e150);
    case 3: return random.chance(0.3) ? Vector(a.rows, 0.0) : ones(a.rows);
    case 4:
        for (double& entry : b)
            entry = random.chance(0.05) ? entry : 0;
        return b;
    default: return product(a, b);
    }
}

Vector start(Random& random, std::uint32_t n)
{
    switch (random.below(5))
    {
    case 0: return random_vector(random, n);
    case 1: return scaled(random_vector(random, n), decades(random, -30, 12));
    default: return {};
    }
}

/// Software drivers take milliseconds a submission: they get one case in four, and fewer iterations.
std::string pick_device(Random& random)
{
    const std::vector<std::string>& all = test_devices();
    std::vector<std::string> cpus, others;
    for (const std::string& selector : all)
        (selector.starts_with("cpu") ? cpus : others).push_back(selector);
    const auto& from = others.empty() || (!cpus.empty() && random.chance(0.7)) ? cpus : others;
    return from[random.below(std::uint32_t(from.size()))];
}

SolveOptions pick_options(Random& random, const SparseMatrix& a, bool cpu)
{
    SolveOptions o;
    o.precision = kPrecisions[random.below(3)];
    o.format = random.chance(0.25) ? Format::automatic : all_formats()[random.below(6)];
    if (o.format == Format::bcsr3 && a.rows % 3 != 0)
        o.format = Format::sell;
    static constexpr std::array kKinds = {Preconditioner::none,         Preconditioner::jacobi,
                                          Preconditioner::block_jacobi, Preconditioner::chebyshev,
                                          Preconditioner::spai0,        Preconditioner::multigrid};
    o.preconditioner = kKinds[random.below(6)];
    if (o.preconditioner == Preconditioner::block_jacobi && a.rows % 3 != 0)
        o.preconditioner = Preconditioner::jacobi;
    o.tolerance = o.precision == SolvePrecision::float32 ? decades(random, -9, -2) : decades(random, -16, -2);
    o.max_iterations = cpu ? (random.chance(0.2) ? 1 + random.below(20) : 600) : 1 + random.below(64);
    o.chebyshev_degree = 1 + int(random.below(6));
    o.one_group = random.chance(0.8);
    o.keep_history = random.chance(0.5);
    return o;
}

System draw(std::uint64_t seed)
{
    Random random(seed);
    System s;
    s.kind = static_cast<Kind>(random.below(static_cast<std::uint32_t>(Kind::count)));
    const std::uint32_t most = random.chance(0.3) ? 8 : random.chance(0.5) ? 100 : 400;
    std::uint32_t n = 1 + random.below(most);
    if (random.chance(0.5))
        n = (n + 2) / 3 * 3;
    s.a = matrix_of(random, s.kind, n);
    s.device = pick_device(random);
    s.options = pick_options(random, s.a, s.device.starts_with("cpu"));
    s.b = right_side(random, s.a);
    s.x0 = start(random, s.a.rows);
    return s;
}

/// Largest and smallest eigenvalue of the matrix as it is and with its diagonal scaled to one.
double lowest_eigenvalue(const SparseMatrix& a)
{
    const auto n = Eigen::Index(a.rows);
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
    for (const Triplet& e : to_triplets(a))
        m(e.row, e.column) = e.value;
    for (Eigen::Index i = 0; i < n; ++i) // signs of eigenvalues do not change with it (Sylvester)
    {
        const double s = m(i, i) > 0 ? 1 / std::sqrt(m(i, i)) : 1;
        m.row(i) *= s;
        m.col(i) *= s;
    }
    return symmetric_eigenvalues(m)[0];
}

struct Tally
{
    int solved = 0, refused = 0, converged = 0;
};

void check_case(std::uint64_t seed, Tally& tally)
{
    const System s = draw(seed);
    INFO("seed " << seed << " kind " << int(s.kind) << " n " << s.a.rows << " on " << s.device << " with "
                 << words_of(s.options) << " iterations " << s.options.max_iterations << " one_group "
                 << s.options.one_group);
    const auto refusal = code_of([&] {
        const Solution solution = solve(test_device(s.device), s.a, s.b, s.options, s.x0);
        check_honest(s.a, s.b, s.options, solution);
        const SolveReport& report = solution.report;
        INFO(to_string(report.status) << ": " << report.reason);
        CHECK(report.iterations <= s.options.max_iterations);
        if (s.options.keep_history && report.status != Status::non_finite)
            for (const float value : report.history)
                CHECK_FALSE(std::isnan(value));
        // Words about the matrix are true of the matrix, not of what a float made of it.
        if (report.status == Status::indefinite_matrix)
            CHECK(lowest_eigenvalue(s.a) < 0);
        // A V-cycle, or blocks in float, may lose their definiteness on matrices of many decades: said of M,
        // not of A.
        const bool exact_inverse = s.options.preconditioner != Preconditioner::multigrid &&
                                   (s.options.preconditioner != Preconditioner::block_jacobi ||
                                    s.options.precision == SolvePrecision::float64);
        if (report.status == Status::indefinite_preconditioner && exact_inverse)
            CHECK(lowest_eigenvalue(s.a) < 0);
        if (s.kind == Kind::dominant && s.options.max_iterations == 600 && s.x0.empty() &&
            s.options.tolerance > (s.options.precision == SolvePrecision::float32 ? 1e-5 : 1e-11))
            CHECK((report.status == Status::converged || report.status == Status::zero_right_hand_side));
        ++tally.solved;
        tally.converged += report.status == Status::converged ? 1 : 0;
    });
    if (!refusal)
        return;
    ++tally.refused;
    CHECK((*refusal == ErrorCode::bad_input || *refusal == ErrorCode::limit));
    if (*refusal == ErrorCode::limit)
        CHECK(s.options.format == Format::ell);
    // The good ones are refused by no one but ELL, and blocks of numbers beyond all bounds.
    if (s.kind == Kind::dominant || s.kind == Kind::gram)
        CHECK((*refusal == ErrorCode::limit || !s.x0.empty()));
}

} // namespace

TEST_CASE("random systems end in a true word")
{
    const std::uint64_t seed = number_of("TAUT_SEED", 1), cases = number_of("TAUT_CASES", 600);
    Tally tally;
    for (std::uint64_t k = number_of("TAUT_FIRST", 0); k < cases; ++k)
        check_case(seed * 1000003 + k, tally);
    // Cases that are all refused, or all hopeless, would show nothing.
    CHECK(tally.solved > int(cases / 2));
    CHECK(tally.converged > int(cases / 5));
    note("property", *test_device("cpu:serial"), "solved", tally.solved);
    note("property", *test_device("cpu:serial"), "refused", tally.refused);
    note("property", *test_device("cpu:serial"), "converged", tally.converged);
}
