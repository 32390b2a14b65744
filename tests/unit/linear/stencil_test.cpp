#include "taut/linear/stencil.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/linear/cg.hpp"
#include "taut/linear/sparse.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

struct Solved
{
    CgOutcome outcome;
    std::vector<double> x;
};

/// b = A 1, solved from 0 on `device`.
Solved solve_for_ones(const std::shared_ptr<Device>& device, std::uint32_t n, Precision precision, bool pairs)
{
    const SparseMatrix matrix = poisson3d(n);
    std::vector<double> b(matrix.rows);
    linear::multiply(matrix, std::vector<double>(matrix.rows, 1), b);
    ConjugateGradient cg(device, std::make_shared<Stencil7>(n, n, n, precision), {}, pairs);
    if (precision == Precision::float64)
        device->write<double>(cg.b(), b);
    std::vector<float> narrow;
    for (const double value : b) // whole numbers: the low words of pairs are 0
    {
        narrow.push_back(static_cast<float>(value));
        if (pairs)
            narrow.push_back(0);
    }
    if (precision == Precision::float32)
        device->write<float>(cg.b(), narrow);
    CgSettings settings;
    settings.tolerance = precision == Precision::float64 || pairs ? 1e-10 : 1e-5;
    cg.set(settings);
    Recorder recorder(device);
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 200);
    cg.record_end(recorder);
    recorder.finish()->replay();

    Solved out;
    out.outcome = cg.outcome();
    if (precision == Precision::float64)
        out.x = device->read<double>(cg.x(), matrix.rows);
    else
    {
        const auto words = device->read<float>(cg.x(), matrix.rows * (pairs ? 2u : 1u));
        for (std::size_t i = 0; i < words.size(); i += pairs ? 2 : 1)
            out.x.push_back(double{words[i]} + (pairs ? double{words[i + 1]} : 0.0));
    }
    return out;
}

double farthest_from_one(const std::vector<double>& x)
{
    double far = 0;
    for (const double value : x)
        far = std::max(far, std::abs(value - 1));
    return far;
}

} // namespace

TEST_CASE("conjugate gradients with the stencil solve Poisson's equation")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto device = test_device(selector);
    CAPTURE(selector);
    if (device->limits().float64)
    {
        const Solved wide = solve_for_ones(device, 12, Precision::float64, false);
        CHECK(wide.outcome.status == Status::converged);
        CHECK(wide.outcome.iterations < 60);
        CHECK(farthest_from_one(wide.x) < 1e-8);
    }
    const Solved narrow = solve_for_ones(device, 12, Precision::float32, false);
    CHECK(narrow.outcome.status == Status::converged);
    CHECK(farthest_from_one(narrow.x) < 1e-3);
    const Solved mixed = solve_for_ones(device, 12, Precision::float32, true);
    CHECK(mixed.outcome.status == Status::converged);
    CHECK(farthest_from_one(mixed.x) < 1e-8);
}

TEST_CASE("conjugate gradients with the stencil give the same bits on every software executor")
{
    const Solved serial = solve_for_ones(test_device("cpu:serial"), 13, Precision::float32, true);
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto device = test_device(selector);
    CAPTURE(selector);
    if (device->info().hardware_gpu)
        return;
    const Solved other = solve_for_ones(device, 13, Precision::float32, true);
    CHECK(other.outcome.iterations == serial.outcome.iterations);
    CHECK((other.x == serial.x));
}

TEST_CASE("the stencil's product is that of the matrix")
{
    const auto device = test_device("cpu");
    const SparseMatrix matrix = poisson3d(9);
    const Stencil7 stencil(9, 9, 9, Precision::float64, 0.5);
    CHECK(stencil.rows() == matrix.rows);
    CHECK(stencil.bytes() == 0);
    std::vector<double> x, want(matrix.rows);
    for (std::uint32_t i = 0; i < matrix.rows; ++i)
        x.push_back(static_cast<double>(i * 37 % 101) - 50);
    linear::multiply(matrix, x, want);
    const BufferPtr x_buffer = device->make_buffer(matrix.rows * 8, "x");
    const BufferPtr y = device->make_buffer(matrix.rows * 8, "y");
    device->write<double>(x_buffer, x);
    Recorder recorder(device);
    stencil.record_product(recorder, {3, nullptr, 0}, x_buffer, y, BufferPtr());
    recorder.finish()->replay();
    const auto have = device->read<double>(y, matrix.rows);
    for (std::uint32_t i = 0; i < matrix.rows; ++i) // whole numbers: exact
        CHECK(have[i] == 0.5 * want[i]);
}

TEST_CASE("a stencil that cannot be is refused in words")
{
    CHECK_THROWS_WITH(Stencil7(0, 1, 1, Precision::float32), Contains("every size must be 1 or more"));
    CHECK_THROWS_WITH(Stencil7(1, 1, 1, Precision::float32, 0.1), Contains("float holds exactly"));
    CHECK_THROWS_WITH(Stencil7(1, 1, 1, Precision::float32, -1), Contains("a positive number"));
    CHECK_THROWS_WITH(Stencil7(65536, 65536, 1, Precision::float32), Contains("at most 2147483647"));
    const auto device = test_device("cpu:serial");
    Recorder recorder(device);
    const BufferPtr buffer = device->make_buffer(64, "x");
    const Stencil7 wide(1, 1, 1, Precision::float64);
    CHECK_THROWS_WITH(wide.record_residual_pairs(recorder, {}, buffer, buffer, buffer), Contains("mixed"));
}
