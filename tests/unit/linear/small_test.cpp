#include "taut/linear/small.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/matrix_market.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>

using namespace taut;
using namespace taut::linear;

namespace {

struct System
{
    SparseMatrix a;
    std::vector<double> b, inverse;
    std::vector<double> x0 = std::vector<double>(b.size(), 0.0);
};

double as_float(double v)
{
    return static_cast<double>(static_cast<float>(v));
}

System with_jacobi(SparseMatrix a, std::vector<double> b)
{
    std::vector<double> inverse = jacobi_inverse(a);
    return {std::move(a), std::move(b), std::move(inverse)};
}

/// Banded, so that LDLT is quick; numbers that float holds, so that every precision solves the same system.
System random_system(conformance::Random& random, std::uint32_t n)
{
    std::vector<Triplet> entries;
    std::vector<double> diagonal(n, 0.05), b;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = i + 1; j < std::min(n, i + 7); ++j)
        {
            if (!random.chance(0.4))
                continue;
            const double v = as_float(random.uniform(-1, 1));
            entries.insert(entries.end(), {{i, j, v}, {j, i, v}});
            diagonal[i] += std::abs(v);
            diagonal[j] += std::abs(v);
        }
    for (std::uint32_t i = 0; i < n; ++i)
    {
        entries.push_back({i, i, as_float(diagonal[i] * random.uniform(1, 1.5))});
        b.push_back(as_float(random.uniform(-1, 1)));
    }
    return with_jacobi(from_triplets(n, n, entries), b);
}

/// 2 and -1; with free ends the first and the last diagonal are 1, and constants are mapped to zero.
SparseMatrix chain(std::uint32_t n, bool free_ends, double sign = 1)
{
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const bool end = i == 0 || i + 1 == n;
        entries.push_back({i, i, sign * (free_ends && end ? 1 : 2)});
        if (i + 1 < n)
            entries.insert(entries.end(), {{i, i + 1, -sign}, {i + 1, i, -sign}});
    }
    return from_triplets(n, n, entries);
}

/// A full matrix: the longest loops there are.
SparseMatrix covariance(std::uint32_t n)
{
    std::vector<double> values;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            values.push_back(std::exp(-std::abs(double(i) - double(j)) / 20) + (i == j ? 0.01 : 0));
    return from_dense(n, n, values);
}

std::vector<double> solve_exactly(const System& s)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triplet& t : to_triplets(s.a))
        entries.emplace_back(int(t.row), int(t.column), t.value);
    Eigen::SparseMatrix<double> a(s.a.rows, s.a.columns);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(a).solve(
        Eigen::Map<const Eigen::VectorXd>(s.b.data(), Eigen::Index(s.b.size())));
    return {x.begin(), x.end()};
}

struct Mode
{
    Precision precision = Precision::float64;
    bool pairs = false;
};
constexpr Mode kFloat{Precision::float32, false};
constexpr Mode kDouble{Precision::float64, false};
constexpr Mode kPairs{Precision::float32, true};

struct Answer
{
    CgOutcome outcome;
    std::vector<double> x, checked;
    std::vector<float> history;
};

struct Solved
{
    std::uint32_t dispatches = 0;
    std::vector<std::uint32_t> turns;
    std::vector<Answer> answers;
};

std::unique_ptr<SmallBatch> make_batch(const std::string& selector, const std::vector<System>& systems,
                                       Mode mode)
{
    std::vector<SparseMatrix> matrices;
    std::vector<std::vector<double>> inverses;
    for (const System& s : systems)
    {
        matrices.push_back(s.a);
        inverses.push_back(s.inverse);
    }
    const std::vector<int> exponents(systems.size(), 0);
    return std::make_unique<SmallBatch>(test_device(selector), matrices, exponents, inverses, mode.precision,
                                        mode.pairs);
}

Solved run(SmallBatch& batch, const std::vector<System>& systems, const CgSettings& settings)
{
    std::vector<double> b, x0;
    for (const System& s : systems)
    {
        b.insert(b.end(), s.b.begin(), s.b.end());
        x0.insert(x0.end(), s.x0.begin(), s.x0.end());
    }
    batch.set(settings);
    batch.start(b, x0);
    Solved out;
    out.dispatches = batch.run();
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        out.turns.push_back(batch.turns(k));
        out.answers.push_back({batch.outcome(k), batch.x(k), batch.checked_x(k), batch.history(k)});
    }
    return out;
}

Solved solve_all(const std::string& selector, const std::vector<System>& systems, Mode mode,
                 const CgSettings& settings)
{
    return run(*make_batch(selector, systems, mode), systems, settings);
}

CgSettings tolerance(double value)
{
    CgSettings settings;
    settings.tolerance = value;
    return settings;
}

bool can(const std::string& selector, Mode mode)
{
    return mode.precision == Precision::float32 || test_device(selector)->limits().float64;
}

/// Bit for bit, NaN too.
template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const Answer& a, const Answer& b)
{
    return a.outcome.cause == b.outcome.cause && a.outcome.iterations == b.outcome.iterations &&
           a.outcome.replacements == b.outcome.replacements && same(a.x, b.x) && same(a.checked, b.checked) &&
           same(a.history, b.history);
}

double difference(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> d = a;
    for (std::size_t i = 0; i < d.size(); ++i)
        d[i] -= b[i];
    return norm(d) / norm(b);
}

struct Thousand
{
    std::vector<System> systems;
    std::vector<std::vector<double>> exact;

    Thousand()
    {
        conformance::Random random(31);
        for (std::uint32_t k = 0; k < 1000; ++k)
        {
            const std::uint32_t edges[] = {1, 2, 127, 128, 129, 1023, 1024};
            systems.push_back(random_system(random, k < 7 ? edges[k] : 1 + random.below(1024)));
            exact.push_back(solve_exactly(systems.back()));
        }
    }
};

/// Systems of every end there is, which 60 iterations bring about.
struct Ends
{
    std::vector<System> systems;
    std::vector<Status> status; ///< what it must be

    void add(System s, Status end)
    {
        systems.push_back(std::move(s));
        status.push_back(end);
    }

    Ends()
    {
        conformance::Random random(32);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        add(random_system(random, 30), Status::converged);
        add({chain(20, false), std::vector<double>(20, 0.0), std::vector<double>(20, 0.5)},
            Status::zero_right_hand_side);
        add(random_system(random, 200), Status::converged);
        add({chain(140, false, -1), std::vector<double>(140, 1.0), std::vector<double>(140, 0.5)},
            Status::indefinite_matrix);
        System poisoned = random_system(random, 129);
        poisoned.b[100] = nan;
        add(poisoned, Status::non_finite);
        add(with_jacobi(chain(500, false), std::vector<double>(500, 1.0)), Status::iteration_limit);
        add({chain(64, true), std::vector<double>(64, 1.0), std::vector<double>(64, 1.0)}, Status::stagnated);
        System turned = random_system(random, 40);
        for (double& m : turned.inverse)
            m = -m; // every row is held: nothing is left to solve
        add(turned, Status::zero_right_hand_side);
        add(random_system(random, 1), Status::converged);
        System spoilt = random_system(random, 33);
        spoilt.x0[7] = nan;
        add(spoilt, Status::non_finite);
        add(random_system(random, 1024), Status::converged);
    }
};

} // namespace

TEST_CASE("a thousand small systems in one batch agree with LDLT", "[linear][small]")
{
    static const Thousand thousand;
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto [mode, wanted, apart] =
        GENERATE(std::tuple{kFloat, 1e-5, 1e-3}, std::tuple{kDouble, 1e-11, 1e-9},
                 std::tuple{kPairs, 1e-10, 1e-8});
    CAPTURE(selector, wanted);
    if (!can(selector, mode))
        return;
    const Solved solved = solve_all(selector, thousand.systems, mode, tolerance(wanted));
    double worst = 0, residual = 0;
    std::size_t converged = 0;
    for (std::size_t k = 0; k < 1000; ++k)
    {
        const System& s = thousand.systems[k];
        converged += solved.answers[k].outcome.status == Status::converged ? 1 : 0;
        residual = std::max(residual, relative_residual(s.a, solved.answers[k].x, s.b));
        worst = std::max(worst, difference(solved.answers[k].x, thousand.exact[k]));
    }
    CHECK(converged == 1000);
    CHECK(residual <= 1.1 * wanted); // the device forms it in its own precision
    CHECK(worst <= apart);
    if (test_device(selector)->info().hardware_gpu)
        return;
    static std::map<double, Solved> on_serial;
    Solved& serial = on_serial[wanted];
    if (serial.answers.empty())
        serial = solve_all("cpu:serial", thousand.systems, mode, tolerance(wanted));
    std::size_t equal = 0;
    for (std::size_t k = 0; k < 1000; ++k)
        equal += same(solved.answers[k], serial.answers[k]) ? 1 : 0;
    CHECK(equal == 1000);
    CHECK(solved.dispatches == serial.dispatches);
}

TEST_CASE("systems of a batch end each in its own way, and as if alone", "[linear][small]")
{
    const Ends ends;
    const std::string selector = GENERATE(from_range(test_devices()));
    const Mode mode = GENERATE(kFloat, kDouble, kPairs);
    CAPTURE(selector, int(mode.precision), mode.pairs);
    if (!can(selector, mode))
        return;
    CgSettings settings = tolerance(1e-5);
    settings.iteration_limit = 60;
    const Solved solved = solve_all(selector, ends.systems, mode, settings);
    for (std::size_t k = 0; k < ends.systems.size(); ++k)
    {
        CAPTURE(k);
        const System& s = ends.systems[k];
        const Answer& answer = solved.answers[k];
        CHECK(to_string(answer.outcome.status) == to_string(ends.status[k]));
        CHECK_FALSE(answer.outcome.running);
        CHECK(answer.history.size() == answer.outcome.iterations + 1);
        if (ends.status[k] == Status::converged)
            CHECK(relative_residual(s.a, answer.x, s.b) <= 1.1e-5);
        if (ends.status[k] == Status::non_finite && !std::isnan(norm(s.b)))
            CHECK(std::isnan(answer.x[7]));
        else
            CHECK(std::isfinite(norm(answer.x)));
        CHECK(same(answer, solve_all(selector, {s}, mode, settings).answers.front()));
    }
    CHECK(solved.answers[5].outcome.iterations == 60);
    CHECK(solved.answers[6].outcome.cause == TAUT_CG_EXHAUSTED);
}

TEST_CASE("a singular system with a right-hand side outside its range never converges", "[linear][small]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Mode mode = GENERATE(kFloat, kDouble, kPairs);
    CAPTURE(selector, int(mode.precision), mode.pairs);
    if (!can(selector, mode))
        return;
    conformance::Random random(33);
    std::vector<System> systems;
    for (const std::uint32_t n : {2u, 3u, 17u, 128u, 300u, 1000u})
    {
        std::vector<double> b;
        for (std::uint32_t i = 0; i < n; ++i)
            b.push_back(as_float(random.uniform(0, 1)));
        systems.push_back(with_jacobi(chain(n, true), b));
    }
    for (const Answer& answer : solve_all(selector, systems, mode, tolerance(1e-6)).answers)
    {
        INFO(to_string(answer.outcome.status));
        CHECK(answer.outcome.status != Status::converged);
        CHECK(std::isfinite(norm(answer.x)));
    }
}

TEST_CASE("held rows of a small system keep their start", "[linear][small]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Mode mode = GENERATE(kDouble, kPairs);
    CAPTURE(selector, mode.pairs);
    if (!can(selector, mode))
        return;
    conformance::Random random(34);
    System s = random_system(random, 150);
    const std::vector<std::uint32_t> held = {0, 77, 149};
    s.inverse = jacobi_inverse(s.a, held);
    for (double& x : s.x0)
        x = random.uniform(-1, 1);
    const Answer answer = solve_all(selector, {s}, mode, tolerance(1e-9)).answers.front();
    CHECK(answer.outcome.status == Status::converged);
    CHECK(relative_residual(s.a, answer.x, s.b, held) <= 1.1e-9);
    for (const std::uint32_t row : held)
        CHECK(std::abs(answer.x[row] - s.x0[row]) <= (mode.pairs ? 0x1p-47 : 0));
}

TEST_CASE("small systems take one dispatch, larger ones as many as their trips need", "[linear][small]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const Mode mode = can(selector, kDouble) ? kDouble : kPairs;
    const auto check = [&](const SparseMatrix& a, std::uint32_t turns, bool one) {
        const System s = with_jacobi(a, std::vector<double>(a.rows, 1.0));
        CgSettings settings = tolerance(1e-8);
        settings.iteration_limit = 2000;
        const Solved solved = solve_all(selector, {s}, mode, settings);
        const Answer& answer = solved.answers.front();
        CAPTURE(a.rows, answer.outcome.iterations, answer.outcome.replacements);
        CHECK(to_string(answer.outcome.status) == "converged");
        CHECK(relative_residual(a, answer.x, s.b) <= 1.1e-8);
        CHECK(solved.turns.front() == turns);
        // A turn is an iteration, or forms the residual anew, first of all at the start.
        const std::uint32_t all = 1 + answer.outcome.iterations + answer.outcome.replacements;
        CHECK(solved.dispatches == (all + turns - 1) / turns);
        CHECK((solved.dispatches == 1) == one);
    };
    // Trips of a turn: 1, (longest row + 1) a tile, 3 * (tiles + 1), 2 * 8; of a dispatch 1 + 2 * (tiles + 1)
    // more.
    check(poisson2d(14), (32000 - 7) / (1 + 2 * 6 + 9 + 16), true);
    check(chain(200, false), (32000 - 7) / (1 + 2 * 4 + 9 + 16), true);
    check(chain(1024, false), (32000 - 19) / (1 + 8 * 4 + 27 + 16), false);
    check(covariance(1024), 3, false);
}

TEST_CASE("a batch solves again with other right-hand sides", "[linear][small]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const Ends ends;
    std::vector<System> other = ends.systems;
    conformance::Random random(35);
    for (System& s : other)
        for (double& b : s.b)
            b = as_float(random.uniform(-1, 1));
    const auto batch = make_batch(selector, ends.systems, kPairs);
    run(*batch, ends.systems, tolerance(1e-5));
    const Solved again = run(*batch, other, tolerance(1e-6));
    const Solved fresh = solve_all(selector, other, kPairs, tolerance(1e-6));
    for (std::size_t k = 0; k < other.size(); ++k)
    {
        CAPTURE(k);
        CHECK(same(again.answers[k], fresh.answers[k]));
    }
}

TEST_CASE("pairs reach ten digits of the true residual", "[linear][small]")
{
    const char* named = std::getenv("TAUT_DATA");
    const std::filesystem::path beside = std::filesystem::path(TAUT_SOURCE_DIR) / ".." / "shared" / "data";
    const std::filesystem::path root = named ? std::filesystem::path(named) : beside;
    const std::filesystem::path file = root / "matrices" / "mesh1e1.mtx";
    conformance::Random random(36);
    std::vector<SparseMatrix> matrices = {poisson2d(30), covariance(200)};
    if (std::filesystem::exists(file))
        matrices.push_back(read_matrix_market(file.string()).matrix);
    else
        WARN("skipped: " + file.string() + " is not there; set TAUT_DATA to the folder of shared data");
    std::vector<System> systems;
    for (SparseMatrix& a : matrices)
    {
        std::vector<double> b;
        for (std::uint32_t i = 0; i < a.rows; ++i)
            b.push_back(random.uniform(-1, 1));
        systems.push_back(with_jacobi(std::move(a), std::move(b)));
    }
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        CAPTURE(k, systems[k].a.rows);
        const System& s = systems[k];
        const Answer answer = solve_all(selector, {s}, kPairs, tolerance(1e-10)).answers.front();
        CHECK(to_string(answer.outcome.status) == "converged");
        CHECK(relative_residual(s.a, answer.x, s.b) <= 1.01e-10);
    }
}

TEST_CASE("a batch refuses what it cannot solve, in words", "[linear][small]")
{
    const auto says = [](const auto& act, const std::string& words) {
        std::string message = "nothing";
        try
        {
            act();
        }
        catch (const Error& error)
        {
            message = error.what();
        }
        CAPTURE(message);
        CHECK(message.find(words) != std::string::npos);
    };
    const System good = with_jacobi(chain(5, false), std::vector<double>(5, 1.0));
    const auto refuses = [&](const System& s, const std::string& words) {
        says([&] { make_batch("cpu:serial", {good, s}, kFloat); }, "system 1 of the batch");
        says([&] { make_batch("cpu:serial", {good, s}, kFloat); }, words);
    };
    refuses(with_jacobi(chain(1025, false), std::vector<double>(1025, 1.0)), "1025 rows");
    refuses({from_triplets(2, 3, {}), {1, 1}, {1, 1}}, "3 columns");
    refuses({chain(5, false), std::vector<double>(5, 1.0), {1, 1}}, "2 values");
    System large = good;
    large.a.value[3] = 1e39;
    refuses(large, "scale_exponent");
    CHECK_THROWS_AS(make_batch("cpu:serial", {}, kFloat), Error);
    CHECK_THROWS_AS(make_batch("cpu:serial", {good}, Mode{Precision::float64, true}), Error);

    const auto batch = make_batch("cpu:serial", {good}, kFloat);
    says([&] { batch->x(0); }, "start and run");
    says([&] { batch->start(std::vector<double>(4, 1.0), {}); }, "5 rows");
    CHECK_THROWS_AS(batch->set(tolerance(0)), Error);
    batch->start(good.b, {});
    CHECK(batch->run() == 1);
    CHECK(batch->outcome(0).status == Status::converged);
}

TEST_CASE("a value is scaled by its exponent before it is rounded", "[linear][small]")
{
    System s = with_jacobi(chain(50, false), std::vector<double>(50, 1.0));
    for (double& v : s.a.value)
        v = std::ldexp(v, 200);
    const int exponent = DeviceMatrix::scale_exponent(s.a);
    SmallBatch batch(test_device("cpu:serial"), std::span(&s.a, 1), std::span(&exponent, 1),
                     std::span(&s.inverse, 1), Precision::float32, false);
    batch.start(s.b, {});
    batch.run();
    std::vector<double> x = batch.x(0);
    for (double& v : x)
        v = std::ldexp(v, exponent);
    CHECK(exponent == -201);
    CHECK(relative_residual(s.a, x, s.b) <= 1e-5);
}
