// Denormals are zero on every executor, whatever its driver and the calling thread make of them
// (taut/runtime/base/flush_denormals.hpp).

#include "support/devices.hpp"
#include "support/kernel_run.hpp"
#include "taut/kernels/spmv_dense.hpp"

#include <cfenv>
#include <cmath>
#include <limits>

using namespace taut;
using namespace taut::conformance;

namespace {

constexpr std::uint32_t kRows = 4;

/// y = A x for a diagonal matrix.
template <typename Real>
std::vector<Real> product(Device& device, const std::vector<Real>& diagonal, const std::vector<Real>& x)
{
    std::vector<Real> values(kRows * kRows);
    for (std::uint32_t i = 0; i < kRows; ++i)
        values[i * kRows + i] = diagonal[i];
    constexpr Precision precision = sizeof(Real) == 8 ? Precision::float64 : Precision::float32;
    const kernels::spmv_dense::Params params{kRows, kRows, 1, 0};
    const Launch launch = make_launch(kernels::spmv_dense::info("", precision), params, 1);
    const Buffers in = {{"values", bytes_of(values)}, {"x", bytes_of(x)}, {"y", bytes_of(values)}};
    std::vector<Real> y = values_of<Real>(run(device, {launch}, in).at("y"));
    y.resize(kRows);
    return y;
}

/// Something that no compiler works out beforehand, smaller than the least normal number.
template <typename Real>
Real denormal_of_host()
{
    const volatile Real least = std::numeric_limits<Real>::min();
    return least * Real(0.25);
}

template <typename Real>
void check_on(Device& device)
{
    CAPTURE(device.info().executor);
    const Real least = std::numeric_limits<Real>::min(), root = std::sqrt(least);
    const Real denormal = denormal_of_host<Real>();
    REQUIRE(std::fpclassify(denormal) == FP_SUBNORMAL);
    const std::vector<Real> y =
        product<Real>(device, {root, denormal, least, least}, {root / 2, 1 / root, 1, Real(1.5)});
    CHECK(y[0] == 0); // a product
    CHECK(y[1] == 0); // a factor
    CHECK(y[2] == least);
    CHECK(y[3] == Real(1.5) * least);
    CHECK(denormal_of_host<Real>() == denormal); // the caller's arithmetic is as before
}

} // namespace

TEST_CASE("denormals are zero on every executor, and stay with the host")
{
    const auto device = test_device(GENERATE(from_range(test_devices())));
    check_on<float>(*device);
    if (device->limits().float64)
        check_on<double>(*device);
}

TEST_CASE("what the host rounds to and keeps changes no bit of a kernel")
{
    const auto device = test_device(GENERATE("cpu:serial", "cpu"));
    const std::vector<float> diagonal = {0.1f, 1.f / 3, 0.7f, 1e-20f}, x = {0.3f, 0.1f, 1.1f, 1e-20f};
    const std::vector<float> nearest = product(*device, diagonal, x);
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    const std::vector<float> upward = product(*device, diagonal, x);
    const int left = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(upward == nearest);
    CHECK(left == FE_UPWARD);
}
