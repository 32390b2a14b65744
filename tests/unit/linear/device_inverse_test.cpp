#include "taut/linear/device_inverse.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"
#include "taut/kernels/cg_collect.hpp"
#include "taut/linear/cg.hpp"
#include "taut/linear/reals.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

/// 3 x 3 blocks in a band, symmetric and diagonally dominant; values that floats hold.
SparseMatrix blocks(std::uint32_t rows, std::uint64_t seed)
{
    conformance::Random random(seed);
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < rows; ++i)
    {
        entries.push_back({i, i, 12 + std::round(random.uniform(0, 64)) / 16});
        for (std::uint32_t j = i / 3 * 3 + (i % 3) + 1; j < std::min(rows, i / 3 * 3 + 6); ++j)
        {
            const double value = std::round(random.uniform(-16, 16)) / 16;
            entries.push_back({i, j, value});
            entries.push_back({j, i, value});
        }
    }
    return from_triplets(rows, rows, entries);
}

struct Setup
{
    Format format;
    Precision precision;
    bool pairs;
    Preconditioner kind;
    double tolerance;
};

/// One recording adds the difference of two matrices, forms the inverse of the sum and solves with it.
void check_step(const std::shared_ptr<Device>& device, const Setup& s)
{
    const SparseMatrix before = blocks(300, 1), after = blocks(300, 2);
    REQUIRE(before.column == after.column);
    const std::uint32_t rows = after.rows;
    const UploadOptions options{s.format, s.precision, s.pairs, 0, false, true};
    const std::shared_ptr<DeviceMatrix> matrix = DeviceMatrix::upload(device, before, options);
    const auto real = std::uint32_t{real_bytes(s.precision)};
    const auto count = static_cast<std::uint32_t>(matrix->values()->bytes() / real);
    std::vector<double> difference(count, 0.0);
    const std::vector<std::uint32_t> slots = matrix->slots(before);
    for (std::size_t k = 0; k < slots.size(); ++k)
        difference[slots[k]] = after.value[k] - before.value[k]; // exact
    const BufferPtr increments = device->make_buffer(matrix->values()->bytes(), "increments");
    write_reals(*device, increments, difference, s.precision);

    const std::vector<std::uint32_t> held = {0, 7, 8, 150, 151, 152, 299};
    std::vector<std::uint32_t> marks(rows, 0);
    for (const std::uint32_t row : held)
        marks[row] = 1;
    const BufferPtr mark_buffer = device->make_buffer(rows * 4ull, "held");
    device->write<std::uint32_t>(mark_buffer, marks);
    const DeviceInverse inverse(device, matrix, before, s.kind, mark_buffer);
    ConjugateGradient cg(device, matrix, {s.kind, inverse.inverse(), nullptr}, s.pairs);
    std::vector<double> b, x0(rows, 0.0);
    for (std::uint32_t i = 0; i < rows; ++i)
        b.push_back(static_cast<double>(static_cast<float>(std::sin(1.0 + i))));
    for (const std::uint32_t row : held)
        x0[row] = 0.5 + row % 3;
    write_reals(*device, cg.b(), s.pairs ? as_pairs(b) : b, s.precision);
    write_reals(*device, cg.x(), s.pairs ? as_pairs(x0) : x0, s.precision);
    cg.set({.tolerance = s.tolerance, .iteration_limit = 60});

    Recorder recorder(device);
    const std::uint32_t groups = group_count_for(count, device->info());
    const Grid grid = make_grid(count, groups);
    launch(recorder, {groups, nullptr, 0}, {"", s.precision, "rewrite"},
           kernels::cg_collect::Bindings<Recorder::Binding>{.base = matrix->values(), .x = increments},
           {grid.count, grid.chunk, 1});
    inverse.record(recorder, {group_count_for(rows, device->info()), nullptr, 0});
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 60);
    cg.record_end(recorder);
    recorder.finish()->replay();

    const bool block = s.kind == Preconditioner::block_jacobi;
    const double unit = s.precision == Precision::float64 ? 0x1p-52 : 0x1p-23;
    const std::vector<double> want =
        block ? block_jacobi_inverse(after, held, unit / 2) : jacobi_inverse(after, held);
    const std::vector<double> have = read_reals(*device, inverse.inverse(), want.size(), s.precision);
    for (std::size_t k = 0; k < want.size(); ++k)
        REQUIRE(std::abs(have[k] - want[k]) <= 0.5 * unit); // entries are 0.1 and less
    std::vector<double> x = read_reals(*device, cg.x(), rows * (s.pairs ? 2u : 1u), s.precision);
    if (s.pairs)
        for (std::uint32_t i = 0; i < rows; ++i)
            x[i] = x[2 * i] + x[2 * i + 1];
    x.resize(rows);
    CHECK(cg.outcome().status == Status::converged);
    CHECK(cg.outcome().iterations < 40);
    CHECK(relative_residual(after, x, b, held) <= s.tolerance);
    for (const std::uint32_t row : held)
        CHECK(x[row] == x0[row]);
}

} // namespace

TEST_CASE("values rewritten, their inverse and the solve are one recording", "[linear][inverse]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Format format = GENERATE(Format::csr, Format::ell, Format::sell, Format::coo, Format::dense,
                                   Format::bcsr3);
    const Preconditioner kind = GENERATE(Preconditioner::jacobi, Preconditioner::block_jacobi);
    CAPTURE(selector, to_string(format), to_string(kind));
    const auto device = test_device(selector);
    check_step(device, {format, Precision::float32, false, kind, 1e-5});
    check_step(device, {format, Precision::float32, true, kind, 1e-11});
    if (device->limits().float64)
        check_step(device, {format, Precision::float64, false, kind, 1e-11});
}

TEST_CASE("a matrix that its inverse cannot be formed for is not called solved", "[linear][inverse]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Preconditioner kind = GENERATE(Preconditioner::jacobi, Preconditioner::block_jacobi);
    const float bad = GENERATE(std::numeric_limits<float>::infinity(),
                               std::numeric_limits<float>::quiet_NaN(), -20.0f);
    CAPTURE(selector, to_string(kind), bad);
    const auto device = test_device(selector);
    const SparseMatrix a = blocks(300, 1);
    const auto matrix =
        DeviceMatrix::upload(device, a, {Format::csr, Precision::float32, false, 0, false, true});
    std::uint32_t diagonal = a.row_start[100];
    while (a.column[diagonal] != 100)
        ++diagonal;
    device->write<float>(matrix->values(), std::vector<float>{bad}, 4ull * matrix->slots(a)[diagonal]);
    const DeviceInverse inverse(device, matrix, a, kind);
    ConjugateGradient cg(device, matrix, {kind, inverse.inverse(), nullptr}, false);
    device->write<float>(cg.b(), std::vector<float>(300, 1.0f));
    cg.set({.tolerance = 1e-5, .iteration_limit = 60});
    Recorder recorder(device);
    inverse.record(recorder, {group_count_for(300, device->info()), nullptr, 0});
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 60);
    cg.record_end(recorder);
    recorder.finish()->replay();
    CHECK(cg.outcome().status == (bad < 0 ? Status::indefinite_matrix : Status::non_finite));
}

TEST_CASE("what no inverse is formed for on a device is refused in words", "[linear][inverse]")
{
    const auto device = test_device("cpu:serial");
    const SparseMatrix a = poisson2d(4);
    const auto matrix = DeviceMatrix::upload(device, a, {});
    const auto attempt = [&](const SparseMatrix& pattern, Preconditioner kind, BufferPtr held = nullptr) {
        DeviceInverse(device, matrix, pattern, kind, std::move(held));
    };
    CHECK_NOTHROW(attempt(a, Preconditioner::jacobi));
    CHECK_THROWS_WITH(attempt(a, Preconditioner::spai0), Contains("spai0") && Contains("take jacobi"));
    CHECK_THROWS_WITH(attempt(a, Preconditioner::block_jacobi), Contains("multiple of 3 rows"));
    CHECK_THROWS_WITH(attempt(poisson2d(3), Preconditioner::jacobi), Contains("9 x 9"));
    CHECK_THROWS_WITH(attempt(a, Preconditioner::jacobi, device->make_buffer(60, "held")),
                      Contains("60 bytes"));
}
