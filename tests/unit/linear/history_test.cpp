#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/linear/solve.hpp"

using namespace taut;
using namespace taut::linear;

TEST_CASE("the history of a solve of several replays has an entry for every iteration", "[linear]")
{
    const SparseMatrix a = poisson2d(60);
    const std::vector<double> b(a.rows, 1.0);
    for (const SolvePrecision precision : {SolvePrecision::float64, SolvePrecision::mixed})
    {
        SolveOptions options;
        options.format = Format::csr;
        options.precision = precision;
        options.tolerance = 1e-5;
        options.keep_history = true;
        const SolveReport report = solve(Device::open("cpu"), a, b, options).report;
        REQUIRE(report.status == Status::converged);
        REQUIRE(report.iterations > 64); // more than one replay
        REQUIRE(report.history.size() == report.iterations + 1);
        CHECK(report.history.front() == 1.0f);
        CHECK(report.history.back() <= 1e-5f);
        for (std::size_t k = 1; k < report.history.size(); ++k)
        {
            INFO("entry " << k);
            CHECK(report.history[k] > 0);
            CHECK(report.history[k] < 20 * report.history[k - 1]);
            CHECK(report.history[k] > report.history[k - 1] / 20);
        }
    }
}
