#include "taut/linear/cg.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/linear/device_matrix.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

BufferPtr upload(Device& device, const std::vector<double>& values)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(double), "test");
    device.write<double>(buffer, values);
    return buffer;
}

/// Jacobi on the 5-point Laplacian of n x n unknowns in double.
struct Problem
{
    SparseMatrix a;
    std::shared_ptr<Device> device;
    std::shared_ptr<DeviceMatrix> matrix;
    std::unique_ptr<ConjugateGradient> cg;
    std::vector<double> exact, b;

    Problem(const std::string& selector, std::uint32_t n, Format format = Format::csr)
        : a(poisson2d(n)),
          device(test_device(selector)),
          matrix(DeviceMatrix::upload(device, a, {format, Precision::float64, false, 0}))
    {
        const Preconditioning jacobi{Preconditioner::jacobi, upload(*device, jacobi_inverse(a)), nullptr};
        cg = std::make_unique<ConjugateGradient>(device, matrix, jacobi, false);
        for (std::uint32_t i = 0; i < a.rows; ++i)
            exact.push_back(std::sin(1.0 + i));
        b.resize(a.rows);
        multiply(a, exact, b);
        device->write<double>(cg->b(), b);
    }

    double true_residual() const { return relative_residual(a, device->read<double>(cg->x(), a.rows), b); }
};

} // namespace

TEST_CASE("a whole solve is one recording, one submission and no read", "[linear][cg]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    Problem problem(selector, 12);
    Recorder recorder(problem.device);
    problem.cg->record_begin(recorder);
    problem.cg->record_iterations(recorder, 80);
    problem.cg->record_end(recorder);
    const auto recording = recorder.finish();
    CHECK(find_hazards(recording->dispatches(), recording->barrier_before()).empty());
    problem.cg->set({.tolerance = 1e-10, .iteration_limit = 80});
    const std::uint64_t before = problem.device->counters().submissions;
    recording->replay();
    problem.device->wait();
    CHECK(problem.device->counters().submissions == before + 1);

    const CgOutcome outcome = problem.cg->outcome();
    CHECK(outcome.status == Status::converged);
    CHECK_FALSE(outcome.running);
    CHECK(outcome.iterations < 60);
    CHECK(problem.true_residual() <= 1e-10);

    SECTION("and solves again from where it is, in no iteration")
    {
        recording->replay();
        CHECK(problem.cg->outcome().status == Status::converged);
        CHECK(problem.cg->outcome().iterations == 0);
    }
    SECTION("and for another right-hand side")
    {
        for (double& value : problem.b)
            value = std::cos(value);
        problem.device->write<double>(problem.cg->b(), problem.b);
        recording->replay();
        CHECK(problem.cg->outcome().status == Status::converged);
        CHECK(problem.true_residual() <= 1e-10);
    }
}

TEST_CASE("an iteration is three dispatches", "[linear][cg]")
{
    Problem problem("cpu:serial", 12);
    Recorder recorder(problem.device);
    problem.cg->record_iterations(recorder, 8);
    const std::size_t eight = recorder.size();
    problem.cg->record_iterations(recorder, 8);
    CHECK(recorder.size() == 2 * eight);
    const auto recording = recorder.finish();
    std::size_t when_replaced = 0; // gated by the other word of the control buffer
    for (const Dispatch& dispatch : recording->dispatches())
        when_replaced += dispatch.indirect.offset == 4 * TAUT_CONTROL_REPLACE ? 1 : 0;
    CHECK(2 * eight - when_replaced == 16 * 3);
}

TEST_CASE("recorded iterations that do not suffice end in iteration_limit with the true residual",
          "[linear][cg]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    Problem problem(selector, 12);
    const std::uint32_t count = GENERATE(0u, 1u, 5u, 8u, 9u);
    Recorder recorder(problem.device);
    problem.cg->record_begin(recorder);
    problem.cg->record_iterations(recorder, count);
    problem.cg->record_end(recorder);
    const auto recording = recorder.finish();
    problem.cg->set({.tolerance = 1e-10, .iteration_limit = count});
    recording->replay();
    const CgOutcome outcome = problem.cg->outcome();
    CHECK(outcome.status == Status::iteration_limit);
    CHECK_FALSE(outcome.running);
    CHECK(outcome.iterations <= count); // fewer where a place was spent on the residual
    CHECK(outcome.iterations + 8 > count);
    CHECK(outcome.residual == Approx(problem.true_residual()).epsilon(1e-9));
    if (count > 0)
        CHECK(outcome.residual < 1);
}

TEST_CASE("a start that is the solution, or near it, costs nothing", "[linear][cg]")
{
    Problem problem("cpu:serial", 12);
    problem.device->write<double>(problem.cg->x(), problem.exact);
    Recorder recorder(problem.device);
    problem.cg->record_begin(recorder);
    problem.cg->record_iterations(recorder, 8);
    problem.cg->record_end(recorder);
    const auto recording = recorder.finish();
    problem.cg->set({.tolerance = 1e-12, .iteration_limit = 8});
    recording->replay();
    CHECK(problem.cg->outcome().status == Status::converged);
    CHECK(problem.cg->outcome().iterations == 0);
}

TEST_CASE("values rewritten on the device are solved with the same recording", "[linear][cg]")
{
    const Format format = GENERATE(Format::csr, Format::ell, Format::sell, Format::coo, Format::dense);
    CAPTURE(to_string(format));
    Problem problem("cpu:serial", 12, format);
    Recorder recorder(problem.device);
    problem.cg->record_begin(recorder);
    problem.cg->record_iterations(recorder, 80);
    problem.cg->record_end(recorder);
    const auto recording = recorder.finish();
    problem.cg->set({.tolerance = 1e-10, .iteration_limit = 80});
    recording->replay();
    CHECK(problem.true_residual() <= 1e-10);

    std::vector<double> values(problem.matrix->values()->bytes() / sizeof(double));
    const std::vector<std::uint32_t> slots = problem.matrix->slots(problem.a);
    REQUIRE(slots.size() == problem.a.nonzeros());
    for (std::size_t k = 0; k < slots.size(); ++k)
    {
        problem.a.value[k] *= problem.a.value[k] > 0 ? 1.5 : 1;
        values[slots[k]] = problem.a.value[k];
    }
    problem.device->write<double>(problem.matrix->values(), values);
    recording->replay();
    CHECK(problem.cg->outcome().status == Status::converged);
    CHECK(problem.true_residual() <= 1e-10);
}

TEST_CASE("the history is the residual of every iteration", "[linear][cg]")
{
    Problem problem("cpu:serial", 12);
    Recorder recorder(problem.device);
    problem.cg->record_begin(recorder);
    problem.cg->record_iterations(recorder, 80);
    const auto recording = recorder.finish();
    problem.cg->set({.tolerance = 1e-10, .iteration_limit = 80});
    recording->replay();
    const CgOutcome outcome = problem.cg->outcome();
    const std::vector<float> history = problem.cg->history(0, outcome.iterations);
    REQUIRE(history.size() == outcome.iterations + 1);
    CHECK(history.front() == 1);
    CHECK(history.back() <= 1e-10F);
    CHECK(history[history.size() / 2] < 1);
}
