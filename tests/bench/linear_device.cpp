// Taut's own conjugate gradients as a rival: recorded once, replayed until the device says that it has ended.

#include "linear_device.hpp"

#include "taut/linear/preconditioner.hpp"
#include "taut/linear/reals.hpp"
#include "taut/linear/stencil.hpp"

#include <limits>

namespace bench {

using namespace taut;
using namespace taut::linear;

namespace {

constexpr std::uint32_t kChunk = 64; // iterations of a replay, as linear::solve has it

} // namespace

DeviceSolver::DeviceSolver(std::shared_ptr<Device> device, std::shared_ptr<const Operator> op,
                           const Preconditioning& preconditioning, const System& system, bool pairs)
    : device_(std::move(device)),
      operator_(std::move(op)),
      pairs_(pairs),
      rows_(system.a.rows),
      cg_(device_, operator_, preconditioning, pairs)
{
    const Precision precision = operator_->precision();
    write_reals(*device_, cg_.b(), pairs ? as_pairs(system.b) : system.b, precision);
    Recorder recorder(device_);
    cg_.record_begin(recorder);
    begin_ = recorder.finish();
    cg_.record_iterations(recorder, kChunk);
    chunk_ = recorder.finish();

    const std::uint64_t bytes = rows_ * std::uint64_t{real_bytes(precision)};
    right_ = device_->make_buffer(bytes, "bench b");
    y_ = device_->make_buffer(bytes, "bench y");
    write_reals(*device_, right_, system.b, precision);
    operator_->record_product(recorder, {group_count_for(rows_, device_->info()), nullptr, 0}, right_, y_,
                              Operator::Binding(nullptr));
    product_ = recorder.finish();
    zero_.assign(rows_ * std::size_t{pairs ? 2u : 1u}, 0.0);
}

int DeviceSolver::solve(double tolerance, int limit)
{
    write_reals(*device_, cg_.x(), zero_, operator_->precision());
    CgSettings settings;
    settings.tolerance = tolerance;
    settings.iteration_limit = static_cast<std::uint32_t>(limit);
    run(settings);
    return static_cast<int>(outcome_.iterations);
}

void DeviceSolver::run(const CgSettings& settings)
{
    cg_.set(settings);
    begin_->replay();
    do
    {
        chunk_->replay();
        outcome_ = cg_.outcome();
    } while (outcome_.running);
}

std::vector<float> DeviceSolver::recursion(std::uint32_t iterations)
{
    write_reals(*device_, cg_.x(), zero_, operator_->precision());
    CgSettings settings;
    settings.tolerance = 1e-18;
    settings.iteration_limit = iterations;
    settings.replacement = 1e-18;
    settings.patience = iterations;
    run(settings);
    return cg_.history(0, outcome_.iterations - 1); // what is behind the last was formed anew
}

std::vector<double> DeviceSolver::x()
{
    const Precision precision = operator_->precision();
    const std::vector<double> gain = read_reals(*device_, cg_.gain(), rows_, precision);
    std::vector<double> x = read_reals(*device_, cg_.x(), zero_.size(), precision);
    for (std::size_t i = 0; i < rows_; ++i)
        x[i] = (pairs_ ? x[2 * i] + x[2 * i + 1] : x[i]) + gain[i];
    x.resize(rows_);
    return x;
}

bool DeviceSolver::product()
{
    product_->replay();
    device_->wait();
    return true;
}

std::vector<double> DeviceSolver::y() { return read_reals(*device_, y_, rows_, operator_->precision()); }

std::unique_ptr<DeviceSolver> device_solver(const std::string& selector, const System& system, Format format,
                                            SolvePrecision precision, bool jacobi)
{
    const std::shared_ptr<Device> device = Device::open(selector);
    const bool pairs = precision == SolvePrecision::mixed;
    const Precision real = precision == SolvePrecision::float64 ? Precision::float64 : Precision::float32;
    const std::shared_ptr<DeviceMatrix> matrix =
        DeviceMatrix::upload(device, system.a, {format, real, pairs, 0});
    Preconditioning preconditioning;
    if (jacobi)
    {
        const std::vector<double> inverse = jacobi_inverse(system.a);
        preconditioning.kind = Preconditioner::jacobi;
        preconditioning.inverse = device->make_buffer(inverse.size() * real_bytes(real), "bench inverse");
        write_reals(*device, preconditioning.inverse, inverse, real);
    }
    return std::make_unique<DeviceSolver>(device, matrix, preconditioning, system, pairs);
}

std::unique_ptr<DeviceSolver> matrix_free_solver(const std::string& selector, const System& system,
                                                 std::uint32_t side)
{
    return std::make_unique<DeviceSolver>(
        Device::open(selector), std::make_shared<Stencil7>(side, side, side, Precision::float64),
        Preconditioning{Preconditioner::none, nullptr, nullptr}, system, false);
}

} // namespace bench
