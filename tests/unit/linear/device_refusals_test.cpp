#include "taut/linear/device_matrix.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/formats.hpp"
#include "taut/linear/grid.hpp"

#include <cmath>
#include <limits>

using namespace taut;
using namespace taut::linear;
using namespace taut::linear::formats_test;

TEST_CASE("a matrix that cannot go to a device is refused in words", "[linear][formats]")
{
    const auto device = test_device("cpu:serial");
    const auto attempt = [&](const SparseMatrix& a, UploadOptions options) {
        return DeviceMatrix::upload(device, a, options);
    };
    const SparseMatrix good = poisson2d(4);
    CHECK_THROWS_WITH(attempt(from_triplets(2, 3, {}), {}), Contains("2 rows and 3 columns"));
    CHECK_THROWS_WITH(attempt(SparseMatrix(), {}), Contains("no rows"));
    CHECK_THROWS_WITH(attempt(good, {Format::automatic, Precision::float64, false, 0}), Contains("\"auto\""));
    CHECK_THROWS_WITH(attempt(good, {Format::csr, Precision::float64, true, 0}),
                      Contains("pairs with float"));
    SparseMatrix large = good;
    large.value[1] = 1e39;
    CHECK_THROWS_WITH(attempt(large, {Format::csr, Precision::float32, false, 0}),
                      Contains("row 0 column 1") && Contains("scale_exponent"));
    CHECK_NOTHROW(attempt(large, {Format::csr, Precision::float64, false, 0}));
}

TEST_CASE("a row that would loop too often is refused where loops are cut short", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto device = test_device(selector);
    CAPTURE(selector);
    const SparseMatrix a = arrow(40'000, {{5, 40'000}});
    const UploadOptions options{Format::sell, Precision::float32, false, 0};
    if (device->info().executor.starts_with("cpu"))
        CHECK_NOTHROW(DeviceMatrix::upload(device, a, options));
    else
        CHECK_THROWS_WITH(DeviceMatrix::upload(device, a, options),
                          Contains("rows 0 to 255") && Contains("32000") && Contains("take csr"));
}

TEST_CASE("a matrix that does not fit the device's largest buffer is refused with its bytes",
          "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const auto device = test_device(selector);
    const std::uint64_t most = device->limits().max_buffer_bytes;
    CAPTURE(selector, most);
    SECTION("4 TiB, found by arithmetic alone: no device here or elsewhere has such a buffer")
    {
        REQUIRE(most < std::uint64_t{1} << 42);
        const std::uint32_t rows = 1u << 20;
        CHECK_THROWS_WITH(
            DeviceMatrix::upload(device, arrow(rows, {}), {Format::dense, Precision::float32, false, 0}),
            Contains("format dense needs 4398046511104 bytes") && Contains(std::to_string(most)));
    }
    SECTION("padding that goes beyond a small largest buffer")
    {
        if (most > std::uint64_t{1} << 28)
        {
            SUCCEED(selector << " has no small largest buffer: more than is worth a test");
            return;
        }
        const auto rows = static_cast<std::uint32_t>(most / (32 * 4) + 1000);
        const UploadOptions options{Format::sell, Precision::float32, false, 0};
        CHECK_THROWS_WITH(DeviceMatrix::upload(device, arrow(rows, {{5, rows}}), options),
                          Contains("format sell needs") && Contains(std::to_string(most)));
    }
}

TEST_CASE("more rows or entries than kernels can number are refused before any work", "[linear][formats]")
{
    const auto device = test_device("cpu:serial");
    SparseMatrix large;
    large.rows = large.columns = (1u << 30) + 1; // no row starts: the count is looked at first
    for (const Format format : formats())
        CHECK_THROWS_WITH(DeviceMatrix::upload(device, large, {format, Precision::float32, false, 0}),
                          Contains("1073741825 rows") && Contains("1073741824"));
    CHECK_NOTHROW(check_row_count(std::uint64_t{1} << 30));
    CHECK_NOTHROW(check_entry_count(std::uint64_t{1} << 31, "format ell"));
    CHECK_THROWS_WITH(check_entry_count((std::uint64_t{1} << 31) + 1, "format ell"),
                      Contains("format ell") && Contains("2147483649") && Contains("2147483648"));
    CHECK(make_grid(1u << 30, 1024).chunk == 1u << 20);
    CHECK(make_grid(3u << 30, 256).chunk == 12u << 20);
    CHECK_THROWS_WITH(make_grid(0xffffffffu, 1), Contains("4294967295"));
}

TEST_CASE("a matrix whose indices lie is refused before it goes to a device", "[linear][formats]")
{
    const Format format = GENERATE(from_range(formats()));
    const auto device = test_device("cpu:serial");
    SparseMatrix a = poisson2d(6);
    a.column[7] = 4'000'000'000u;
    CHECK_THROWS_WITH(DeviceMatrix::upload(device, a, {format, Precision::float32, false, 0}),
                      Contains("column 4000000000") && Contains("36 columns"));
}
