#include "support/data.hpp"
#include "support/skip.hpp"
#include "support/small_systems.hpp"

using namespace taut;
using namespace taut::linear;
using namespace taut::linear::small_systems;

TEST_CASE("a thousand small systems in one batch agree with LDLT", "[linear][small]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto [mode, wanted, apart] =
        GENERATE(std::tuple{kFloat, 1e-5, 1e-3}, std::tuple{kDouble, 1e-11, 1e-9},
                 std::tuple{kPairs, 1e-10, 1e-8});
    CAPTURE(selector, wanted);
    if (!can(selector, mode))
        return;
    // A driver that is software takes ten seconds for a thousand; a hundred have every size that is special.
    const bool software = selector.rfind("cpu", 0) != 0 && !test_device(selector)->info().hardware_gpu;
    const bool few = software && environment_has("TAUT_LINEAR_SHORT");
    static const RandomSystems thousand(1000), hundred(100);
    const auto& [systems, exact] = few ? hundred : thousand;
    const Solved solved = solve_all(selector, systems, mode, tolerance(wanted));
    double worst = 0, residual = 0;
    std::size_t converged = 0;
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        const System& s = systems[k];
        converged += solved.answers[k].outcome.status == Status::converged ? 1 : 0;
        residual = std::max(residual, relative_residual(s.a, solved.answers[k].x, s.b));
        worst = std::max(worst, difference(solved.answers[k].x, exact[k]));
    }
    CHECK(converged == systems.size());
    CHECK(residual <= 1.1 * wanted); // the device forms it in its own precision
    CHECK(worst <= apart);
    if (test_device(selector)->info().hardware_gpu)
        return;
    static std::map<std::pair<double, bool>, Solved> on_serial;
    Solved& serial = on_serial[{wanted, few}];
    if (serial.answers.empty())
        serial = solve_all("cpu:serial", systems, mode, tolerance(wanted));
    std::size_t equal = 0;
    for (std::size_t k = 0; k < systems.size(); ++k)
        equal += same(solved.answers[k], serial.answers[k]) ? 1 : 0;
    CHECK(equal == systems.size());
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
    const std::filesystem::path file = data_folder() / "matrices" / "mesh1e1.mtx";
    conformance::Random random(36);
    std::vector<SparseMatrix> matrices = {poisson2d(30), covariance(200)};
    if (std::filesystem::exists(file))
        matrices.push_back(read_matrix_market(file.string()).matrix);
    else
        TAUT_LEFT_OUT(file.string() + " is not there; set TAUT_DATA to the folder of shared data");
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
