#include "taut/linear/cg.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/preconditioner.hpp"

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"
#include "support/symmetric.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

using namespace taut;
using namespace taut::linear;
using taut::conformance::Random;

namespace {

Eigen::MatrixXd dense(const SparseMatrix& a)
{
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(a.rows, a.columns);
    for (const Triplet& t : to_triplets(a))
        m(t.row, t.column) += t.value;
    return m;
}

/// Random and diagonally dominant, rows of sizes over four decades.
SparseMatrix random_spd(std::uint32_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> size(n), sum(n, 0.1);
    for (double& s : size)
        s = std::pow(10.0, random.uniform(-1, 1));
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            if (random.chance(0.2))
            {
                const double v = random.uniform(-1, 1);
                sum[i] += std::abs(v);
                sum[j] += std::abs(v);
                entries.push_back({i, j, v * size[i] * size[j]});
                entries.push_back({j, i, v * size[i] * size[j]});
            }
    for (std::uint32_t i = 0; i < n; ++i)
        entries.push_back({i, i, sum[i] * size[i] * size[i]});
    return from_triplets(n, n, entries);
}

/// Of D^-1/2 A D^-1/2 over the rows that are not held, by Eigen.
double largest_eigenvalue(const SparseMatrix& a, const std::vector<double>& inverse)
{
    const Eigen::Map<const Eigen::VectorXd> m(inverse.data(), Eigen::Index(inverse.size()));
    const Eigen::VectorXd root = m.cwiseSqrt();
    const Eigen::MatrixXd s = root.asDiagonal() * dense(a) * root.asDiagonal();
    return s.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
}

/// Algorithm 12.1 of Saad's book by plain loops, with coefficients rounded to float as the device has them.
std::vector<double> polynomial(const SparseMatrix& a, const std::vector<double>& inverse, Interval interval,
                               int degree, const std::vector<double>& r)
{
    const double theta = (interval.highest + interval.lowest) / 2;
    const double delta = (interval.highest - interval.lowest) / 2;
    const double sigma = theta / delta;
    std::vector<double> rest = r, d(r.size()), z(r.size(), 0), q(r.size());
    double rho = 1 / sigma;
    for (std::size_t i = 0; i < r.size(); ++i)
        d[i] = double(float(1 / theta)) * inverse[i] * rest[i];
    for (int k = 1; k <= degree; ++k)
    {
        multiply(a, d, q);
        const double after = 1 / (2 * sigma - rho);
        const double momentum = double(float(after * rho)), gain = double(float(2 * after / delta));
        for (std::size_t i = 0; i < r.size(); ++i)
        {
            z[i] += d[i];
            rest[i] -= q[i];
            d[i] = momentum * d[i] + gain * inverse[i] * rest[i];
        }
        rho = after;
    }
    return z;
}

struct Applied
{
    std::vector<double> z, partials;
};

template <typename Real>
std::vector<double> read_reals(Device& device, const BufferPtr& buffer, std::size_t n)
{
    const std::vector<Real> values = device.read<Real>(buffer, n);
    return {values.begin(), values.end()};
}

template <typename Real>
BufferPtr upload(Device& device, const std::vector<double>& values)
{
    BufferPtr buffer = device.make_buffer(values.size() * sizeof(Real), "test");
    device.write<Real>(buffer, std::vector<Real>(values.begin(), values.end()));
    return buffer;
}

/// Applies the preconditioner of a matrix to vectors on one device.
template <typename Real>
class Bench
{
public:
    Bench(const std::string& selector, const SparseMatrix& a, const std::vector<double>& inverse,
          Interval interval, int degree, bool gated = false)
        : device_(test_device(selector)),
          rows_(a.rows),
          groups_(group_count_for(a.rows, device_->info()))
    {
        const Precision precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
        const auto matrix = DeviceMatrix::upload(device_, a, {Format::csr, precision, false, 0});
        chebyshev_ =
            std::make_unique<Chebyshev>(device_, matrix, upload<Real>(*device_, inverse), interval, degree);
        r_ = device_->make_buffer(rows_ * sizeof(Real), "r");
        z_ = device_->make_buffer(rows_ * sizeof(Real), "z");
        partials_ = device_->make_buffer(groups_ * sizeof(Real), "partials");
        control_ = device_->make_buffer(32, "control");
        Recorder recorder(device_);
        chebyshev_->record(recorder, gated ? Gate{groups_, control_, 16} : Gate{groups_, nullptr, 0}, r_, z_,
                           partials_);
        recording_ = recorder.finish();
    }

    Applied apply(const std::vector<double>& r, bool open = true)
    {
        const std::uint32_t n = open ? groups_ : 0;
        device_->write<std::uint32_t>(control_, std::vector<std::uint32_t>{7, 7, 7, 7, n, 1, 1, 7});
        device_->write<Real>(r_, std::vector<Real>(r.begin(), r.end()));
        recording_->replay();
        return {read_reals<Real>(*device_, z_, rows_), read_reals<Real>(*device_, partials_, groups_)};
    }

    std::uint32_t groups() const { return groups_; }
    const Recording& recording() const { return *recording_; }

private:
    std::shared_ptr<Device> device_;
    std::uint32_t rows_, groups_;
    std::unique_ptr<Chebyshev> chebyshev_;
    BufferPtr r_, z_, partials_, control_;
    std::unique_ptr<Recording> recording_;
};

std::vector<double> random_vector(std::uint32_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> v(n);
    for (double& entry : v)
        entry = random.uniform<float>(-1, 1); // the same in both precisions
    return v;
}

/// The preconditioner as a matrix: applied to each unit vector.
Eigen::MatrixXd as_matrix(Bench<double>& bench, std::uint32_t n)
{
    Eigen::MatrixXd m(n, n);
    for (std::uint32_t j = 0; j < n; ++j)
    {
        std::vector<double> unit(n, 0);
        unit[j] = 1;
        const std::vector<double> z = bench.apply(unit).z;
        for (std::uint32_t i = 0; i < n; ++i)
            m(i, j) = z[i];
    }
    return m;
}

} // namespace

TEST_CASE("chebyshev_interval comes close to the largest eigenvalue that Eigen finds", "[linear][chebyshev]")
{
    const int which = GENERATE(0, 1, 2, 3, 4);
    const SparseMatrix a = which == 0   ? poisson2d(14)
                           : which == 1 ? poisson3d(6)
                           : which == 2 ? random_spd(40, 1)
                           : which == 3 ? random_spd(150, 2)
                                        : from_triplets(1, 1, std::vector<Triplet>{{0, 0, 3}});
    std::vector<std::uint32_t> held;
    if (which == 2)
        held = {0, 7, 39};
    const std::vector<double> inverse = jacobi_inverse(a, held);
    const double largest = largest_eigenvalue(a, inverse);
    const Interval interval = chebyshev_interval(a, inverse);
    CAPTURE(which, largest, interval.highest);
    CHECK(interval.highest >= largest * (1 - 1e-12));
    CHECK(interval.highest <= largest * 1.05 * (1 + 1e-12));
    CHECK(interval.lowest == Approx(interval.highest / 30).epsilon(1e-15));
    CHECK(chebyshev_interval(a, inverse, 100).lowest == Approx(interval.highest / 100).epsilon(1e-15));
}

TEST_CASE("chebyshev_interval stays below Gershgorin's bound", "[linear][chebyshev]")
{
    // The bound, 2, is the largest eigenvalue itself, and 1.05 times what Lanczos finds would be above.
    const SparseMatrix a =
        from_triplets(2, 2, std::vector<Triplet>{{0, 0, 1}, {0, 1, -1}, {1, 0, -1}, {1, 1, 1}});
    CHECK(chebyshev_interval(a, jacobi_inverse(a)).highest == 2);
}

TEST_CASE("chebyshev_interval of nothing is an interval", "[linear][chebyshev]")
{
    const SparseMatrix empty = from_triplets(4, 4, {});
    const std::vector<std::uint32_t> all = {0, 1, 2, 3};
    for (const Interval interval : {chebyshev_interval(empty, jacobi_inverse(empty)),
                                    chebyshev_interval(poisson2d(2), jacobi_inverse(poisson2d(2), all)),
                                    chebyshev_interval(SparseMatrix{}, std::vector<double>{})})
    {
        CHECK(interval.lowest > 0);
        CHECK(interval.highest > interval.lowest);
        CHECK(std::isfinite(interval.highest));
    }
}

TEST_CASE("chebyshev_interval and Chebyshev refuse what makes no polynomial", "[linear][chebyshev]")
{
    const SparseMatrix a = poisson2d(3);
    const std::vector<double> inverse = jacobi_inverse(a);
    CHECK_THROWS_AS(chebyshev_interval(a, std::vector<double>(8, 1.0)), Error);
    CHECK_THROWS_AS(chebyshev_interval(a, inverse, 1), Error);
    CHECK_THROWS_AS(chebyshev_interval(a, inverse, std::numeric_limits<double>::quiet_NaN()), Error);
    std::vector<double> negative = inverse;
    negative[5] = -1;
    CHECK_THROWS_WITH(chebyshev_interval(a, negative), Contains("-1 in row 5"));

    CHECK_THROWS_AS(Bench<double>("cpu:serial", a, inverse, {0.1, 2}, 0), Error);
    CHECK_THROWS_AS(Bench<double>("cpu:serial", a, inverse, {0.1, 2}, 17), Error);
    CHECK_THROWS_AS(Bench<double>("cpu:serial", a, inverse, {0, 2}, 4), Error);
    CHECK_THROWS_AS(Bench<double>("cpu:serial", a, inverse, {2, 2}, 4), Error);
    CHECK_THROWS_AS(Bench<double>("cpu:serial", a, {1, 1}, {0.1, 2}, 4), Error);
}

TEMPLATE_TEST_CASE("the polynomial on a device is that of plain loops", "[linear][chebyshev]", float, double)
{
    using Real = TestType;
    const std::string selector = GENERATE(from_range(test_devices()));
    if (sizeof(Real) == 8 && !test_device(selector)->limits().float64)
        return;
    const int degree = GENERATE(1, 2, 3, 4, 7, 16);
    for (const std::uint32_t side : {1u, 9u, 20u}) // 1, 81 and 400 rows: one group and four
    {
        CAPTURE(selector, degree, side);
        const SparseMatrix a = poisson2d(side);
        const std::vector<std::uint32_t> held =
            side == 1 ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{3, 64, 80};
        const std::vector<double> inverse = jacobi_inverse(a, held);
        const Interval interval = chebyshev_interval(a, inverse);
        Bench<Real> bench(selector, a, inverse, interval, degree);
        CHECK(find_hazards(bench.recording().dispatches(), bench.recording().barrier_before()).empty());
        const std::vector<double> r = random_vector(a.rows, side);
        const std::vector<double> expected = polynomial(a, inverse, interval, degree, r);
        const Applied out = bench.apply(r);

        // Sums of terms of the size of the largest entry: rounding grows with the degree, by no more.
        const double unit = (sizeof(Real) == 8 ? 0x1p-53 : 0x1p-24) * 20 * degree;
        double largest = 0;
        for (const double v : expected)
            largest = std::max(largest, std::abs(v));
        std::vector<double> sums(bench.groups(), 0), sizes(bench.groups(), 0);
        const Grid grid = make_grid(a.rows, bench.groups());
        for (std::uint32_t i = 0; i < a.rows; ++i)
        {
            CHECK(std::abs(out.z[i] - expected[i]) <= unit * largest);
            sums[i / grid.chunk] += r[i] * expected[i];
            sizes[i / grid.chunk] += std::abs(r[i]) * largest;
        }
        for (const std::uint32_t i : held)
            CHECK(out.z[i] == 0);
        for (std::uint32_t g = 0; g < bench.groups(); ++g)
            CHECK(std::abs(out.partials[g] - sums[g]) <= unit * sizes[g]);
    }
}

TEST_CASE("the polynomial is symmetric positive definite, and as near to the inverse as the theory says",
          "[linear][chebyshev]")
{
    const int degree = GENERATE(1, 2, 3, 4, 5, 8, 16);
    const bool holding = GENERATE(false, true);
    CAPTURE(degree, holding);
    const SparseMatrix a = random_spd(36, 21);
    std::vector<std::uint32_t> held;
    if (holding)
        held = {0, 17};
    const std::vector<double> inverse = jacobi_inverse(a, held);
    const Interval interval = chebyshev_interval(a, inverse);
    Bench<double> bench("cpu:serial", a, inverse, interval, degree);
    Eigen::MatrixXd m = as_matrix(bench, a.rows);
    Eigen::VectorXd root(a.rows); // D^1/2, and 1 in held rows
    for (std::uint32_t i = 0; i < a.rows; ++i)
        root[i] = inverse[i] > 0 ? 1 / std::sqrt(inverse[i]) : 1;
    const Eigen::MatrixXd scaled = root.asDiagonal() * m * root.asDiagonal(); // q(S)
    CHECK((scaled - scaled.transpose()).norm() <= 1e-14 * scaled.norm());
    for (const std::uint32_t row : held)
    {
        CHECK(m.row(row).norm() == 0);
        CHECK(m.col(row).norm() == 0);
        m(row, row) = 1; // what is left to look at are the others
    }
    Eigen::MatrixXd s = root.cwiseInverse().asDiagonal() * dense(a) * root.cwiseInverse().asDiagonal();
    for (const std::uint32_t row : held)
    {
        s.row(row).setZero();
        s.col(row).setZero();
        s(row, row) = 1;
    }
    const Spectrum spectrum = symmetric_spectrum(s);
    const double sigma = (interval.highest + interval.lowest) / (interval.highest - interval.lowest);
    const double bound = 1 / std::cosh(degree * std::acosh(sigma));
    for (Eigen::Index k = 0; k < s.rows(); ++k)
    {
        const Eigen::VectorXd v = spectrum.vectors.col(k);
        const double lambda = spectrum.values[k], q = v.dot(scaled * v);
        bool is_held = false;
        for (const std::uint32_t row : held)
            is_held = is_held || std::abs(v[row]) > 0.5;
        if (is_held)
            continue;
        CAPTURE(k, lambda, q);
        CHECK(q > 0);
        if (lambda >= interval.lowest && lambda <= interval.highest)
            CHECK(std::abs(1 - lambda * q) <= bound + 1e-6);
    }
}

TEST_CASE("a closed gate leaves z and the partial sums alone", "[linear][chebyshev]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const SparseMatrix a = poisson2d(20);
    const std::vector<double> inverse = jacobi_inverse(a);
    Bench<float> bench(selector, a, inverse, chebyshev_interval(a, inverse), 4, true);
    const std::vector<double> r = random_vector(a.rows, 5);
    const Applied closed = bench.apply(r, false);
    CHECK(closed.z == std::vector<double>(a.rows, 0));
    CHECK(closed.partials == std::vector<double>(bench.groups(), 0));
    const Applied open = bench.apply(r, true);
    CHECK(open.z != closed.z);
    CHECK(bench.apply(random_vector(a.rows, 6), false).z == open.z);
}

TEST_CASE("conjugate gradients with a polynomial leave held rows out of the residual", "[linear][chebyshev]")
{
    const std::string selector = GENERATE(from_range(test_devices()));
    CAPTURE(selector);
    const auto device = test_device(selector);
    const SparseMatrix a = poisson2d(12);
    const std::vector<std::uint32_t> held = {5, 70};
    const std::vector<double> inverse = jacobi_inverse(a, held);
    const auto matrix = DeviceMatrix::upload(device, a, {Format::csr, Precision::float64, false, 0});
    const BufferPtr buffer = upload<double>(*device, inverse);
    Preconditioning with;
    with.kind = Preconditioner::chebyshev;
    with.inverse = buffer;
    with.stored = std::make_shared<Chebyshev>(device, matrix, buffer, chebyshev_interval(a, inverse), 4);
    ConjugateGradient cg(device, matrix, with, false);
    cg.set({.tolerance = 1e-10, .iteration_limit = 60});
    std::vector<double> b = random_vector(a.rows, 8), x(a.rows, 0);
    x[5] = 3; // so the residual of these rows never is zero
    x[70] = -2;
    device->write<double>(cg.b(), b);
    device->write<double>(cg.x(), x);
    Recorder recorder(device);
    cg.record_begin(recorder);
    cg.record_iterations(recorder, 60);
    cg.record_end(recorder);
    recorder.finish()->replay();
    CHECK(cg.outcome().status == Status::converged);
    const std::vector<double> solution = device->read<double>(cg.x(), a.rows);
    CHECK((solution[5] == 3 && solution[70] == -2));
    CHECK(relative_residual(a, solution, b, held) <= 1e-10);
}
