// Rows and matrices that are too large for a format, a loop or a device.

#include "linear_hard/cases.hpp"

#include "taut/linear/device_matrix.hpp"

#include <set>

using namespace taut;
using namespace taut::linear;

namespace {

constexpr std::uint32_t kRows = 100002; // a multiple of 3, above the 65,535 trips of lavapipe's loops

/// A diagonal and one dense row and column.
SparseMatrix arrow()
{
    std::vector<Triplet> t;
    for (std::uint32_t i = 1; i < kRows; ++i)
        for (const auto& [r, c, v] : {Triplet{i, i, 2}, {0, i, -1.0 / 512}, {i, 0, -1.0 / 512}})
            t.push_back({r, c, v});
    t.push_back({0, 0, 2});
    return from_triplets(kRows, kRows, t);
}

} // namespace

TEST_CASE("D14: a dense row of 100,002 entries is solved or refused with limit")
{
    const SparseMatrix a = arrow();
    Vector exact(kRows);
    for (std::uint32_t i = 0; i < kRows; ++i)
        exact[i] = 1 + i % 5;
    const Vector b = product(a, exact);
    on_every_device([&](const std::shared_ptr<Device>& device) {
        std::set<Format> taken;
        for (const Format format : all_formats())
            for (const SolvePrecision precision : kPrecisions)
            {
                SolveOptions options;
                options.format = format;
                options.precision = precision;
                options.tolerance = precision == SolvePrecision::float32 ? 1e-5 : 1e-10;
                options.max_iterations = 100;
                CAPTURE(words_of(options));
                const auto code = code_of([&] {
                    const Solution s = solve_checked(device, a, b, options);
                    CAPTURE(s.report.reason);
                    CHECK(s.report.status == Status::converged);
                    CHECK(forward_error(s.x, exact) < 10 * options.tolerance);
                    CHECK(s.report.iterations < 20); // three different eigenvalues
                });
                CHECK(code.value_or(ErrorCode::limit) == ErrorCode::limit);
                if (!code)
                    taken.insert(format);
            }
        CHECK(taken.contains(Format::csr));
        CHECK(taken.contains(Format::coo));
        CHECK_FALSE(taken.contains(Format::ell));   // 10^10 stored entries
        CHECK_FALSE(taken.contains(Format::dense)); // the same
        SolveOptions options;
        options.max_iterations = 100;
        const Solution s = solve_checked(device, a, b, options); // `auto` takes one that can
        CHECK(s.report.status == Status::converged);
        CHECK(taken.contains(s.report.format));
    });
}

TEST_CASE("a matrix larger than a device's buffers is refused with both numbers before anything is made")
{
    on_every_device([&](const std::shared_ptr<Device>& device) {
        const std::uint64_t most = device->limits().max_buffer_bytes;
        const auto side = static_cast<std::uint32_t>(std::sqrt(double(most) / 4)) + 2; // dense, in float
        const SparseMatrix a = diagonal(ones(side));
        const std::uint64_t before = device->counters().bytes_allocated;
        SolveOptions options;
        options.format = Format::dense;
        options.precision = SolvePrecision::float32;
        std::string message;
        try
        {
            solve(device, a, ones(side), options);
        }
        catch (const Error& error)
        {
            CHECK(error.code() == ErrorCode::limit);
            message = error.what();
        }
        CAPTURE(message);
        CHECK(message.find(std::to_string(most)) != std::string::npos);
        CHECK(message.find(std::to_string(4ull * side * side)) != std::string::npos);
        CHECK(message.find("dense") != std::string::npos);
        CHECK(device->counters().bytes_allocated == before);
    });
}
