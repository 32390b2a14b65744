#include "taut/linear/device_matrix.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/formats.hpp"
#include "support/random.hpp"
#include "taut/linear/grid.hpp"

#include <cmath>
#include <limits>

using namespace taut;
using namespace taut::linear;
using namespace taut::linear::formats_test;
using taut::conformance::Random;

namespace {

/// Symmetric and banded, so that every format takes it; rows are a multiple of 3, and some hold nothing.
SparseMatrix banded(std::uint32_t rows, Random& random)
{
    std::vector<Triplet> triplets;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = i; j < std::min(i + 7, rows); ++j)
            if (i % 50 != 4 && j % 50 != 4 && (i == j || random.chance(0.6)))
            {
                const double value = random.uniform(-1, 1);
                triplets.push_back({i, j, value});
                if (i != j)
                    triplets.push_back({j, i, value});
            }
    return from_triplets(rows, rows, triplets);
}

struct Answer
{
    std::vector<double> y, r, pairs;
    std::vector<double> partials;
    bool same_y = true; ///< without the dot product y is the same to the last bit
};

template <typename Real>
std::vector<Real> rounded(const std::vector<double>& values)
{
    std::vector<Real> out;
    for (const double v : values)
        out.push_back(static_cast<Real>(v));
    return out;
}

template <typename Real>
std::vector<float> as_pairs(const std::vector<Real>& values)
{
    std::vector<float> out;
    for (const Real v : values)
    {
        out.push_back(static_cast<float>(v));
        out.push_back(static_cast<float>(v - static_cast<Real>(out.back())));
    }
    return out;
}

template <typename T>
BufferPtr upload(Device& device, const std::vector<T>& values)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(T), "test");
    device.write<T>(buffer, values);
    return buffer;
}

template <typename Real>
Answer run(const std::shared_ptr<Device>& device, const DeviceMatrix& matrix, const std::vector<double>& x,
           const std::vector<double>& b, bool pairs)
{
    const std::uint32_t rows = matrix.rows(), groups = group_count_for(rows, device->info());
    const std::vector<Real> garbage(rows, Real(-77));
    const BufferPtr xs = upload(*device, rounded<Real>(x)), bs = upload(*device, rounded<Real>(b));
    const BufferPtr y = upload(*device, garbage), dotted = upload(*device, garbage),
                    r = upload(*device, garbage);
    const BufferPtr partials = upload(*device, std::vector<Real>(groups, Real(-77)));
    const BufferPtr fine = upload(*device, garbage);
    Recorder recorder(device);
    const Gate gate{groups, nullptr, 0};
    matrix.record_product(recorder, gate, xs, y, BufferPtr());
    matrix.record_product(recorder, gate, xs, dotted, partials);
    matrix.record_residual(recorder, gate, xs, bs, r);
    if (pairs)
        matrix.record_residual_pairs(recorder, gate, upload(*device, as_pairs(x)),
                                     upload(*device, as_pairs(b)), fine);
    recorder.finish()->replay();
    const auto read = [&](const BufferPtr& buffer, std::size_t count) {
        const auto values = device->read<Real>(buffer, count);
        return std::vector<double>(values.begin(), values.end());
    };
    return {read(y, rows), read(r, rows), read(fine, rows), read(partials, groups),
            device->read<Real>(y, rows) == device->read<Real>(dotted, rows)};
}

std::vector<double> random_vector(Random& random, std::uint32_t n)
{
    std::vector<double> values;
    for (std::uint32_t i = 0; i < n; ++i)
        values.push_back(random.uniform<float>(-1, 1));
    return values;
}

/// Largest |difference| over the size of the terms.
double error_of(const SparseMatrix& a, const std::vector<double>& x, const std::vector<double>& b,
                const std::vector<double>& want, const std::vector<double>& have)
{
    double worst = 0;
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        double size = b.empty() ? 1e-300 : std::abs(b[i]) + 1e-300;
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
            size += std::abs(a.value[k] * x[a.column[k]]);
        const double error = std::abs(want[i] - have[i]) / size;
        worst = std::isnan(error) ? error : std::max(worst, error);
        if (std::isnan(worst))
            return std::numeric_limits<double>::infinity();
    }
    return worst;
}

/// Product, dot product and both residuals of a matrix on a device against fp64.
template <typename Real>
void check_passes(const std::shared_ptr<Device>& device, const SparseMatrix& a, const UploadOptions& options)
{
    Random random(77);
    const std::vector<double> x = random_vector(random, a.rows);
    std::vector<double> want(a.rows), b(a.rows), r(a.rows);
    multiply(a, x, want);
    for (std::uint32_t i = 0; i < a.rows; ++i) // nearly solved
        b[i] = want[i] * (1 + 1e-4 * random.uniform(-1, 1)) + (a.row_length(i) == 0 ? 0.5 : 0);
    residual(a, x, b, r);
    const auto matrix = DeviceMatrix::upload(device, a, options);
    const Answer answer = run<Real>(device, *matrix, x, b, options.pairs);
    const double eps = std::numeric_limits<Real>::epsilon();
    CHECK(answer.same_y);
    CHECK(error_of(a, x, {}, want, answer.y) < 4 * eps);
    CHECK(error_of(a, x, b, r, answer.r) < 4 * eps);
    double dot = 0, size = 0, sum = 0;
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        dot += x[i] * want[i];
        size += std::abs(x[i] * want[i]);
    }
    for (const double part : answer.partials)
        sum += part;
    CHECK(std::abs(sum - dot) < 10 * eps * size);
    if (options.pairs) // as many digits as the residual has: not those of the product
        CHECK(error_of(a, x, b, r, answer.pairs) < 1e-11);
    CHECK(matrix->rows() == a.rows);
    CHECK(matrix->format() == options.format);
    CHECK(matrix->bytes() == matrix_bytes(options.format, a, options.precision, options.pairs));
    CHECK(device->counters().validation_messages == 0);
}

} // namespace

TEST_CASE("products and residuals of every format agree with fp64", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Format format = GENERATE(from_range(formats()));
    const std::uint32_t rows = GENERATE(3u, 63u, 129u, 999u);
    CAPTURE(selector, to_string(format), rows);
    const auto device = test_device(selector);
    Random random(rows);
    const SparseMatrix a = banded(rows, random);
    check_passes<float>(device, a, {format, Precision::float32, false, 0});
    check_passes<float>(device, a, {format, Precision::float32, true, 0});
    if (device->limits().float64)
        check_passes<double>(device, a, {format, Precision::float64, false, 0});
}

TEST_CASE("one dense row of 100,000 entries", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    const Format format = GENERATE(Format::csr, Format::coo);
    CAPTURE(selector, to_string(format));
    const SparseMatrix a = arrow(100'000, {{70'000, 100'000}});
    check_passes<float>(test_device(selector), a, {format, Precision::float32, true, 0});
}

TEST_CASE("formats take 1 x 1, one row of several groups' entries, and rows without any", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const auto device = test_device(selector);
    for (const Format format : {Format::dense, Format::coo, Format::csr, Format::sell})
    {
        CAPTURE(to_string(format));
        check_passes<float>(device, from_triplets(1, 1, std::vector<Triplet>{{0, 0, 2.5}}),
                            {format, Precision::float32, true, 0});
        check_passes<float>(device,
                            from_triplets(400, 400, std::vector<Triplet>{{399, 399, 3}, {130, 7, -1}}),
                            {format, Precision::float32, true, 0});
        check_passes<float>(device, arrow(999, {{0, 999}, {998, 700}}),
                            {format, Precision::float32, true, 0});
    }
    check_passes<float>(device, from_triplets(3, 3, std::vector<Triplet>{{1, 1, 2.5}}),
                        {Format::bcsr3, Precision::float32, true, 0});
    check_passes<float>(device, arrow(999, {{0, 999}, {998, 700}}),
                        {Format::bcsr3, Precision::float32, true, 0});
}

TEST_CASE("what dense, coo and bcsr3 cannot take is refused in words", "[linear][formats]")
{
    const auto device = test_device("cpu:serial");
    CHECK_THROWS_WITH(
        DeviceMatrix::upload(device, poisson2d(4), {Format::bcsr3, Precision::float32, false, 0}),
        Contains("multiple of 3") && Contains("16"));
    CHECK_THROWS_WITH(
        DeviceMatrix::upload(device, arrow(70'000, {}), {Format::dense, Precision::float32, false, 0}),
        Contains("format dense"));
    const auto coo = DeviceMatrix::upload(device, poisson2d(20), {Format::coo, Precision::float32, false, 0});
    Recorder recorder(device);
    const BufferPtr v = device->make_buffer(4000, "v");
    CHECK_THROWS_WITH(coo->record_product(recorder, {3, nullptr, 0}, v, v, BufferPtr()),
                      Contains("packed for passes"));
    CHECK_THROWS_WITH(coo->record_residual_pairs(recorder, {4, nullptr, 0}, v, v, v),
                      Contains("without `pairs`"));
}

TEST_CASE("compressed rows around the length from which a group takes them", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const SparseMatrix a = arrow(2000, {{0, 512}, {500, 512}, {511, 511}, {640, 2000}, {1999, 1500}});
    check_passes<float>(test_device(selector), a, {Format::csr, Precision::float32, true, 0});
    if (test_device(selector)->limits().float64)
        check_passes<double>(test_device(selector), a, {Format::csr, Precision::float64, false, 0});
}

TEST_CASE("values are rewritten on the device through their slots", "[linear][formats]")
{
    const Format format = GENERATE(from_range(formats()));
    CAPTURE(to_string(format));
    const auto device = test_device("cpu:serial");
    Random random(5);
    for (const SparseMatrix& a :
         {banded(300, random), arrow(700, {{3, 40}}), arrow(700, {{3, 600}, {600, 700}})})
    {
        if ((format == Format::ell && row_statistics(a).longest > 30) ||
            (format == Format::bcsr3 && a.rows % 3 != 0))
            continue;
        SparseMatrix other = a;
        for (double& value : other.value)
            value = random.uniform(-3, 3);
        const auto matrix = DeviceMatrix::upload(device, a, {format, Precision::float64, false, 0});
        const auto slots = matrix->slots(a);
        REQUIRE(slots.size() == a.value.size());
        auto values = device->read<double>(matrix->values(), matrix->values()->bytes() / 8);
        for (std::size_t k = 0; k < slots.size(); ++k)
        {
            REQUIRE(slots[k] < values.size());
            CHECK(values[slots[k]] == a.value[k]);
            values[slots[k]] = other.value[k];
        }
        device->write<double>(matrix->values(), values);
        const std::vector<double> x = random_vector(random, a.rows);
        std::vector<double> want(a.rows);
        multiply(other, x, want);
        CHECK(error_of(other, x, {}, want, run<double>(device, *matrix, x, x, false).y) < 1e-15);
    }
}

TEST_CASE("a rectangular matrix with rows without entries reads no further than x goes", "[linear][formats]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const auto device = test_device(selector);
    const SparseMatrix a = from_triplets(300, 2, std::vector<Triplet>{{0, 0, 2}, {299, 1, 3}});
    const auto matrix = DeviceMatrix::upload(device, a, {Format::csr, Precision::float32, false, 0, true});
    // Behind the two entries of x there is what no zero can be multiplied with.
    std::vector<float> x(300, std::numeric_limits<float>::quiet_NaN());
    x[0] = 5;
    x[1] = 7;
    const BufferPtr xs = upload(*device, x), y = upload(*device, std::vector<float>(300, -77.0f));
    Recorder recorder(device);
    matrix->record_product(recorder, {3, nullptr, 0}, xs, y, BufferPtr());
    recorder.finish()->replay();
    std::vector<float> want(300, 0);
    want[0] = 10;
    want[299] = 21;
    CHECK(device->read<float>(y, 300) == want);
}

TEST_CASE("the exponent brings the largest value to [1, 2)", "[linear][formats]")
{
    const double scale = GENERATE(1.0, 1e30, 1e-30, 1e300, 1e-300, 0x1p-1074);
    SparseMatrix a = from_triplets(2, 2, std::vector<Triplet>{{0, 0, 3 * scale}, {1, 1, -5 * scale}});
    const int exponent = DeviceMatrix::scale_exponent(a);
    CAPTURE(scale, exponent);
    const double largest = std::ldexp(5 * scale, exponent);
    CHECK((largest >= 1 && largest < 2));
    const auto device = test_device("cpu:serial");
    for (const Format format : formats())
    {
        if (format != Format::bcsr3) // 2 rows
        {
            const auto matrix = DeviceMatrix::upload(device, a, {format, Precision::float32, true, exponent});
            const auto answer = run<float>(device, *matrix, {1, 1}, {0, 0}, false);
            CHECK(answer.y[1] == static_cast<double>(static_cast<float>(-largest)));
        }
    }
    CHECK(DeviceMatrix::scale_exponent(from_triplets(2, 2, {})) == 0);
}
