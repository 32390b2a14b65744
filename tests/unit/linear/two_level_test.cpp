#include "taut/linear/two_level.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "taut/linear/cg.hpp"
#include "taut/linear/check.hpp"
#include "taut/linear/device_inverse.hpp"
#include "taut/linear/partition.hpp"
#include "taut/linear/reals.hpp"

#include <cmath>

using namespace taut;
using namespace taut::linear;

namespace {

constexpr std::uint32_t kSide = 24;
constexpr std::uint32_t kRows = 3 * kSide * kSide;

/// M + k L of a net of side x side vertices with diagonals: L is the Laplacian, alike in x, y and z. Masses
/// of 1; what holds for k large is that of implicit Euler with stiff springs.
SparseMatrix net(double k)
{
    std::vector<Triplet> entries;
    const auto couple = [&](std::uint32_t v, std::uint32_t w) {
        for (std::uint32_t c = 0; c < 3; ++c)
        {
            entries.push_back({3 * v + c, 3 * v + c, k});
            entries.push_back({3 * w + c, 3 * w + c, k});
            entries.push_back({3 * v + c, 3 * w + c, -k});
            entries.push_back({3 * w + c, 3 * v + c, -k});
        }
    };
    for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i)
        {
            const std::uint32_t v = j * kSide + i;
            for (std::uint32_t c = 0; c < 3; ++c)
                entries.push_back({3 * v + c, 3 * v + c, 1});
            if (i + 1 < kSide)
                couple(v, v + 1);
            if (j + 1 < kSide)
                couple(v, v + kSide);
            if (i + 1 < kSide && j + 1 < kSide)
                couple(v, v + kSide + 1);
        }
    return from_triplets(kRows, kRows, entries);
}

std::vector<double> right_hand_side()
{
    std::vector<double> b;
    for (std::uint32_t i = 0; i < kRows; ++i)
        b.push_back(static_cast<double>(static_cast<float>(std::sin(1.0 + i % 97))));
    return b;
}

struct Solved
{
    std::uint32_t iterations = 0;
    double residual = 0; ///< true, of A x = b without the held rows
    Status status = Status::iteration_limit;
};

/// `formed`: the matrix that the coarse level is made of, where it is another one.
Solved solve(const std::shared_ptr<Device>& device, const SparseMatrix& a, std::uint32_t aggregates,
             Precision precision, std::span<const std::uint32_t> held, const SparseMatrix* formed = nullptr)
{
    const auto matrix = DeviceMatrix::upload(device, formed != nullptr ? *formed : a,
                                             {Format::bcsr3, precision, false, 0, false, true});
    std::vector<std::uint32_t> marks(kRows, 0);
    for (const std::uint32_t row : held)
        marks[row] = 1;
    const BufferPtr mark_buffer = device->make_buffer(kRows * 4ull, "held");
    device->write<std::uint32_t>(mark_buffer, marks);
    const DeviceInverse blocks(device, matrix, a, Preconditioner::block_jacobi, mark_buffer);
    const DeviceInverse mask(device, matrix, a, Preconditioner::jacobi, mark_buffer);
    Preconditioning preconditioning{Preconditioner::block_jacobi, blocks.inverse(), nullptr};
    std::shared_ptr<const TwoLevel> levels;
    const Gate always{group_count_for(kRows, device->info()), nullptr, 0};
    if (aggregates > 0)
    {
        const auto parts = partition(a, aggregates, std::vector<bool>(kRows / 3, false));
        levels = std::make_shared<TwoLevel>(device, matrix, a, blocks.inverse(), parts);
        preconditioning = {Preconditioner::multigrid, mask.inverse(), levels};
        Recorder recorder(device);
        levels->form(recorder, always);
        recorder.finish()->replay();
    }
    const auto slots = matrix->slots(a);
    std::vector<double> values(matrix->values()->bytes() / real_bytes(precision), 0.0);
    for (std::size_t k = 0; k < slots.size(); ++k)
        values[slots[k]] = a.value[k];
    write_reals(*device, matrix->values(), values, precision);

    ConjugateGradient cg(device, matrix, preconditioning, false);
    const std::vector<double> b = right_hand_side();
    write_reals(*device, cg.b(), b, precision);
    write_reals(*device, cg.x(), std::vector<double>(kRows, 0.0), precision);
    cg.set({.tolerance = 1e-5, .iteration_limit = 600});
    Recorder recorder(device);
    blocks.record(recorder, always);
    mask.record(recorder, always);
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 600);
    cg.record_end(recorder);
    recorder.finish()->replay();
    const std::vector<double> x = read_reals(*device, cg.x(), kRows, precision);
    for (const std::uint32_t row : held)
        CHECK(x[row] == 0);
    return {cg.outcome().iterations, relative_residual(a, x, b, held), cg.outcome().status};
}

} // namespace

TEST_CASE("with two levels a net of stiff springs takes a third of the iterations, half of them in float",
          "[linear][two_level]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const auto device = test_device(selector);
    const SparseMatrix a = net(1e4);
    const std::vector<std::uint32_t> held = {0, 1, 2, 3 * (kSide - 1), 500};
    std::vector<Precision> precisions = {Precision::float32};
    if (device->limits().float64)
        precisions.push_back(Precision::float64);
    for (const Precision precision : precisions)
    {
        const Solved one = solve(device, a, 0, precision, held);
        const Solved two = solve(device, a, 36, precision, held);
        INFO(one.iterations << " and " << two.iterations);
        CHECK(one.status == Status::converged);
        CHECK(two.status == Status::converged);
        CHECK(one.residual <= 1e-5);
        CHECK(two.residual <= 1e-5);
        // In float the inverse of a coarse system that one vertex holds is off where that system is softest.
        CHECK((precision == Precision::float64 ? 3 : 2) * two.iterations <= one.iterations);
    }
}

TEST_CASE("a coarse level of another matrix still helps, and one aggregate is the motion of all",
          "[linear][two_level]")
{
    const auto device = test_device("cpu:serial");
    const SparseMatrix a = net(1e4), softer = net(5e3), stiffer = net(3e4);
    const std::vector<std::uint32_t> held = {0, 1, 2};
    const Solved one = solve(device, a, 0, Precision::float32, held);
    for (const SparseMatrix* formed : {&softer, &stiffer})
    {
        const Solved two = solve(device, a, 36, Precision::float32, held, formed);
        CHECK(two.status == Status::converged);
        CHECK(5 * two.iterations <= 4 * one.iterations);
    }
    // Nothing held: what an iteration for each scale takes away first is that all move alike.
    const Solved free = solve(device, a, 1, Precision::float64, {});
    CHECK(free.status == Status::converged);
    CHECK(free.residual <= 1e-5);
}

TEST_CASE("a matrix that is not positive definite is no solved system", "[linear][two_level]")
{
    const auto device = test_device("cpu:serial");
    SparseMatrix a = net(1e4);
    for (std::uint32_t k = a.row_start[300]; k < a.row_start[301]; ++k)
        if (a.column[k] == 300)
            a.value[k] = -1e6;
    const Solved solved = solve(device, a, 36, Precision::float32, {});
    CHECK(solved.status != Status::converged);
}

TEST_CASE("what TwoLevel cannot be made of is refused", "[linear][two_level]")
{
    const auto device = test_device("cpu:serial");
    const SparseMatrix a = net(1);
    const auto rows =
        DeviceMatrix::upload(device, a, {Format::csr, Precision::float32, false, 0, false, true});
    const auto blocks =
        DeviceMatrix::upload(device, a, {Format::bcsr3, Precision::float32, false, 0, false, true});
    const BufferPtr inverse = device->make_buffer(kRows * 8ull, "inverse");
    const std::vector<std::uint32_t> all(kRows / 3, 0), none(kRows / 3, kNoPart), few(7, 0);
    std::vector<std::uint32_t> many;
    for (std::uint32_t v = 0; v < kRows / 3; ++v)
        many.push_back(v % (TwoLevel::kMostAggregates + 1));
    CHECK_THROWS_WITH(TwoLevel(device, rows, a, inverse, all), Contains("bcsr3"));
    CHECK_THROWS_WITH(TwoLevel(device, blocks, a, inverse, few), Contains("each of its block rows"));
    CHECK_THROWS_WITH(TwoLevel(device, blocks, a, inverse, none), Contains("0 aggregates"));
    CHECK_THROWS_WITH(TwoLevel(device, blocks, a, inverse, many), Contains("1 to 80"));
}
