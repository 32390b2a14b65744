// A linear system as passes of a plan: made on paper, run on every executor.

#include "taut/plan/solve.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/reals.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

constexpr std::uint32_t kRows = 300;

/// Scene of nothing but its method: what PlanSolve reads.
Scene scene_of(std::string precision, std::uint32_t limit, double tolerance)
{
    Scene scene = test::hanging(2);
    scene.method.precision = option_named<Precision>(std::move(precision));
    scene.method.linear_iterations = limit;
    scene.method.linear_tolerance = tolerance;
    return scene;
}

/// Symmetric, diagonally dominant 3 x 3 blocks in a band.
linear::SparseMatrix band()
{
    std::vector<linear::Triplet> entries;
    for (std::uint32_t i = 0; i < kRows; ++i)
    {
        entries.push_back({i, i, 9.0 + i % 4});
        for (std::uint32_t j = i + 1; j < std::min(kRows, i / 3 * 3 + 6); ++j)
            for (const auto& [row, column] : {std::pair(i, j), std::pair(j, i)})
                entries.push_back({row, column, 0.25 * ((i + j) % 5) - 0.5});
    }
    return linear::from_triplets(kRows, kRows, entries);
}

struct Made
{
    Plan plan;
    std::uint32_t b, x, inverse;
};

/// The same system solved `solves` times in a row, with or without two held rows.
Made make(const Scene& scene, const linear::SparseMatrix& a, int solves, bool held)
{
    const DeviceTraits traits; // the builder keeps references
    const PlanOptions plan_options;
    PlanBuilder builder(scene, traits, plan_options);
    const linear::UploadOptions options{linear::Format::bcsr3, builder.plan.precision, false, 0, false, true};
    const auto matrix = linear::DeviceMatrix::upload(builder.paper(), a, options);
    BufferPtr marks;
    if (held)
    {
        std::vector<std::uint32_t> words(kRows, 0);
        words[4] = words[299] = 1;
        marks = builder.paper()->make_buffer(kRows * 4, "held", BufferUse::device);
        builder.paper()->write<std::uint32_t>(marks, words);
    }
    const auto kind = linear::Preconditioner::block_jacobi;
    const auto inverse = std::make_shared<linear::DeviceInverse>(builder.paper(), matrix, a, kind, marks);
    PlanSolve solve(builder, "test", matrix, {kind, inverse->inverse(), nullptr}, {inverse});
    for (int k = 0; k < solves; ++k)
        solve.record(builder);
    builder.finish_paper();
    builder.plan.barrier_before = derive_barriers(builder.plan.passes);
    return {std::move(builder.plan), solve.b(), solve.x(), solve.inverse()};
}

std::vector<double> right_hand_side()
{
    std::vector<double> b;
    for (std::uint32_t i = 0; i < kRows; ++i)
        b.push_back(std::sin(1.0 + i));
    return b;
}

/// Runs the plan's passes once; gives x and the log.
struct Outcome
{
    std::vector<double> x;
    layout::SolveLog<float> log;
};

Outcome run(const Made& made, const std::string& selector, const std::vector<double>& b, int times = 1)
{
    const auto device = test_device(selector);
    std::vector<BufferPtr> buffers;
    for (const PlanBuffer& buffer : made.plan.buffers)
    {
        buffers.push_back(device->make_buffer(buffer.bytes, buffer.name));
        if (!buffer.initial.empty())
            device->write(buffers.back(), 0, buffer.initial);
    }
    linear::write_reals(*device, buffers[made.b], b, made.plan.precision);
    const auto recording = device->compile({buffers, made.plan.passes, made.plan.barrier_before});
    for (int k = 0; k < times; ++k)
        recording->replay();
    const PlanSolver& solver = made.plan.solvers.at(0);
    return {linear::read_reals(*device, buffers[made.x], kRows, made.plan.precision),
            device->read<layout::SolveLog<float>>(buffers[solver.log], 1).front()};
}

} // namespace

TEST_CASE("a solve of a plan finds the solution and counts itself", "[solve]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const std::string precision = GENERATE("float", "double");
    CAPTURE(selector, precision);
    const double tolerance = precision == "double" ? 1e-11 : 1e-5;
    const linear::SparseMatrix a = band();
    const Made made = make(scene_of(precision, 60, tolerance), a, 1, false);
    CHECK(made.plan.solvers.size() == 1);
    CHECK(find_hazards(made.plan.passes, made.plan.barrier_before).empty());
    const Outcome out = run(made, selector, right_hand_side());
    CHECK(linear::relative_residual(a, out.x, right_hand_side()) <= 2 * tolerance);
    CHECK((out.log.solves == 1 && out.log.limited == 0 && out.log.failed == 0));
    CHECK(out.log.last_status == TAUT_CG_CONVERGED);
    CHECK((out.log.most == out.log.iterations && out.log.iterations > 3 && out.log.iterations < 60));
}

TEST_CASE("held rows keep their entry of x, and the others solve without them", "[solve]")
{
    const linear::SparseMatrix a = band();
    const Made made = make(scene_of("double", 60, 1e-11), a, 1, true);
    REQUIRE(made.inverse != kNoBuffer);
    const Outcome out = run(made, "cpu", right_hand_side());
    CHECK((out.x[4] == 0 && out.x[299] == 0));
    const std::vector<std::uint32_t> held = {4, 299};
    CHECK(linear::relative_residual(a, out.x, right_hand_side(), held) <= 1e-11);
}

TEST_CASE("the log adds up over solves and replays", "[solve]")
{
    const Made made = make(scene_of("double", 60, 1e-11), band(), 2, false);
    const std::string selector = GENERATE(from_range(test_devices()));
    const Outcome out = run(made, selector, right_hand_side(), 3);
    CHECK(out.log.solves == 6);
    CHECK(out.log.iterations == out.log.most); // x stays, so only the first solve has anything left to do
    CHECK(out.log.last_status == TAUT_CG_CONVERGED);
    CHECK(run(made, selector, std::vector<double>(kRows, 0.0)).log.solves == 0);
}

TEST_CASE("a solve at its limit of iterations says so and keeps what it gained", "[solve]")
{
    const linear::SparseMatrix a = band();
    const Outcome out = run(make(scene_of("double", 3, 1e-11), a, 1, false), "cpu", right_hand_side());
    CHECK(out.log.limited == 1);
    CHECK(out.log.failed == 0);
    CHECK((out.log.most >= 1 && out.log.most <= 3)); // one of its places forms the residual anew
    CHECK(out.log.last_status == TAUT_CG_ITERATION_LIMIT);
    const double left = linear::relative_residual(a, out.x, right_hand_side());
    CHECK((left > 1e-11 && left < 0.1));
}

TEST_CASE("a right-hand side that is not finite leaves x as it was", "[solve]")
{
    std::vector<double> b = right_hand_side();
    b[7] = std::numeric_limits<double>::quiet_NaN();
    const Outcome out = run(make(scene_of("double", 30, 1e-11), band(), 1, false), "cpu", b);
    CHECK((out.log.failed == 1 && out.log.last_status == TAUT_CG_NON_FINITE));
    CHECK(std::all_of(out.x.begin(), out.x.end(), [](double x) { return x == 0; }));
}

TEST_CASE("all that a solve takes stands in the plan under its effect", "[solve]")
{
    const Made made = make(scene_of("float", 20, 1e-5), band(), 1, false);
    const Plan& plan = made.plan;
    REQUIRE(plan.effects.size() == 1);
    CHECK(plan.effects[0].name == "test");
    CHECK(plan.effects[0].bytes_allocated == plan.bytes_allocated());
    CHECK(plan.effects[0].dispatches_per_step == plan.passes.size());
    // Inverse; begin 3; 20 iterations of 3; the residual anew 3 after 8, 16 and 20; end 1 + 3 + 1 + 1; log.
    CHECK(plan.passes.size() == 1 + 3 + 20 * 3 + 3 * 3 + 6 + 1);
}
