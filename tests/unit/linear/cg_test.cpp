#include "taut/linear/cg.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/kernels/cg_collect.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/reals.hpp"

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

namespace {

/// `values`, each rounded; with `pairs` a high and a low word in turn.
template <typename Real>
std::vector<Real> words_of(const std::vector<double>& values, bool pairs)
{
    std::vector<Real> out;
    for (const double value : values)
    {
        out.push_back(static_cast<Real>(value));
        if (pairs)
            out.push_back(static_cast<Real>(value - static_cast<double>(out.back())));
    }
    return out;
}

template <typename Real>
std::vector<double> from_words(const std::vector<Real>& words, bool pairs)
{
    std::vector<double> out;
    for (std::size_t k = 0; k < words.size(); k += pairs ? 2 : 1)
        out.push_back(static_cast<double>(words[k]) + (pairs ? static_cast<double>(words[k + 1]) : 0));
    return out;
}

/// One recording adds to the values of a matrix, then solves with it. The values uploaded fit no float, so
/// that low words of theirs would spoil the residual.
template <typename Real>
void check_rewritten(const std::shared_ptr<Device>& device, Format format, bool pairs, double tolerance)
{
    SparseMatrix a = poisson2d(12);
    for (double& value : a.value)
        value *= 1.1;
    const Precision precision = sizeof(Real) == 4 ? Precision::float32 : Precision::float64;
    const UploadOptions options{format, precision, pairs, 0, false, true};
    const auto matrix = DeviceMatrix::upload(device, a, options);
    const std::vector<std::uint32_t> slots = matrix->slots(a);
    const auto count = static_cast<std::uint32_t>(matrix->values()->bytes() / sizeof(Real));
    std::vector<Real> added(count, Real(0));
    for (std::size_t k = 0; k < slots.size(); ++k)
    {
        const Real more = a.value[k] > 0 ? Real(0.7) : Real(0); // of the diagonal
        added[slots[k]] = more;
        a.value[k] = static_cast<double>(static_cast<Real>(a.value[k]) + more);
    }
    const BufferPtr increments = device->make_buffer(count * sizeof(Real), "increments");
    device->write<Real>(increments, added);
    const BufferPtr inverse = device->make_buffer(a.rows * sizeof(Real), "inverse");
    write_reals(*device, inverse, jacobi_inverse(a), precision);
    ConjugateGradient cg(device, matrix, {Preconditioner::jacobi, inverse, nullptr}, pairs);
    std::vector<double> b;
    for (std::uint32_t i = 0; i < a.rows; ++i)
        b.push_back(std::sin(1.0 + i));
    const std::vector<Real> b_words = words_of<Real>(b, pairs);
    device->write<Real>(cg.b(), b_words);
    cg.set({.tolerance = tolerance, .iteration_limit = 120});

    Recorder recorder(device);
    const std::uint32_t groups = group_count_for(count, device->info());
    const Grid grid = make_grid(count, groups);
    launch(recorder, {groups, nullptr, 0}, {"", precision, "rewrite"},
           kernels::cg_collect::Bindings<Recorder::Binding>{.base = matrix->values(), .x = increments},
           {grid.count, grid.chunk, 1});
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 120);
    cg.record_end(recorder);
    recorder.finish()->replay();

    const auto values = device->read<Real>(matrix->values(), count);
    for (std::size_t k = 0; k < slots.size(); ++k)
        REQUIRE(static_cast<double>(values[slots[k]]) == a.value[k]);
    const auto x = from_words(device->read<Real>(cg.x(), a.rows * (pairs ? 2u : 1u)), pairs);
    CHECK(cg.outcome().status == Status::converged);
    CHECK(relative_residual(a, x, from_words(b_words, pairs)) <= tolerance);
}

} // namespace

TEST_CASE("values that a kernel rewrites in the recording are those that are solved", "[linear][cg]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Format format = GENERATE(Format::csr, Format::ell, Format::sell, Format::coo, Format::dense,
                                   Format::bcsr3);
    CAPTURE(selector, to_string(format));
    const auto device = test_device(selector);
    check_rewritten<float>(device, format, false, 1e-5);
    check_rewritten<float>(device, format, true, 1e-11);
    if (device->limits().float64)
        check_rewritten<double>(device, format, false, 1e-11);
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
