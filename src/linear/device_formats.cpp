#include "taut/linear/device_formats.hpp"

#include <algorithm>
#include <cmath>
#include <new>

namespace taut::linear {
namespace {

/// values[slots[k]] = value k times 2^exponent, in `Real`; low words likewise where wanted.
template <typename Real>
struct Packed
{
    std::vector<Real> values, low;
    bool needs_low = false;
};

[[noreturn]] void throw_too_large(const SparseMatrix& matrix, std::size_t entry, int exponent)
{
    const auto after =
        std::upper_bound(matrix.row_start.begin(), matrix.row_start.end(), static_cast<std::uint32_t>(entry));
    throw Error(ErrorCode::bad_input,
                "the value " + std::to_string(matrix.value[entry]) + " of row " +
                    std::to_string(after - matrix.row_start.begin() - 1) + " column " +
                    std::to_string(matrix.column[entry]) + " (from 0) times 2^" + std::to_string(exponent) +
                    " does not fit a float: take the exponent of DeviceMatrix::scale_exponent, or double");
}

template <typename Real>
Packed<Real> pack(const SparseMatrix& matrix, std::span<const std::uint32_t> slots, std::uint64_t count,
                  int exponent, bool pairs)
{
    Packed<Real> packed;
    packed.values.assign(count, Real(0));
    if (pairs)
        packed.low.assign(count, Real(0));
    for (std::size_t k = 0; k < matrix.value.size(); ++k)
    {
        const double value = std::ldexp(matrix.value[k], exponent);
        const Real high = static_cast<Real>(value);
        if (std::isinf(high) && !std::isinf(matrix.value[k]))
            throw_too_large(matrix, k, exponent);
        packed.values[slots[k]] = high;
        if (!pairs)
            continue;
        const Real low = static_cast<Real>(value - static_cast<double>(high));
        packed.low[slots[k]] = low;
        packed.needs_low = packed.needs_low || low != Real(0);
    }
    return packed;
}

} // namespace

PackedMatrix::PackedMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                           const UploadOptions& options)
    : device_(device),
      rows_(matrix.rows),
      precision_(options.precision),
      format_(options.format),
      keeps_low_(options.pairs && !options.rewritable),
      exponent_(options.exponent)
{}

void PackedMatrix::record_product(Recorder& recorder, const Gate& gate, Binding x, Binding y,
                                  Binding partials) const
{
    const std::string_view variant = partials.buffer ? "dot" : "";
    record(recorder, gate, {variant, x, y, partials, {}});
}

void PackedMatrix::record_residual(Recorder& recorder, const Gate& gate, Binding x, Binding b,
                                   Binding r) const
{
    record(recorder, gate, {"residual", x, r, {}, b});
}

void PackedMatrix::record_residual_pairs(Recorder& recorder, const Gate& gate, Binding x, Binding b,
                                         Binding r) const
{
    record(recorder, gate, {"residual_pairs", x, r, {}, b});
}

void PackedMatrix::check_bytes(std::uint64_t wanted, std::string_view what) const
{
    const std::uint64_t most = device_->limits().max_buffer_bytes;
    if (wanted > most)
        throw Error(ErrorCode::limit, "format " + std::string(to_string(format_)) + " needs " +
                                          std::to_string(wanted) + " bytes for " + std::string(what) +
                                          ", but " + device_->info().selector + " allows " +
                                          std::to_string(most) +
                                          " in one buffer: take a sparser format, float, or another device");
}

void PackedMatrix::check_trips(std::uint32_t units,
                               const std::function<std::uint64_t(std::uint32_t, std::uint32_t)>& trips) const
{
    if (is_native())
        return;
    const Grid grid = make_grid(units, group_count_for(rows_, device_->info()));
    for (std::uint64_t begin = 0; begin < units; begin += grid.chunk)
    {
        std::uint64_t sum = 0;
        const std::uint64_t end = std::min<std::uint64_t>(begin + grid.chunk, units);
        for (std::uint64_t tile = begin; tile < end; tile += TAUT_LINEAR_GROUP)
            sum +=
                1 + trips(static_cast<std::uint32_t>(tile),
                          static_cast<std::uint32_t>(std::min<std::uint64_t>(tile + TAUT_LINEAR_GROUP, end)));
        if (sum > kMaxLoopTrips)
            throw Error(ErrorCode::limit, "format " + std::string(to_string(format_)) + " would loop " +
                                              std::to_string(sum) + " times in one of the rows " +
                                              std::to_string(begin) + " to " + std::to_string(end - 1) +
                                              " (from 0), and " + std::to_string(kMaxLoopTrips) +
                                              " times are safe on " + device_->info().selector +
                                              ": take csr, coo or the device cpu");
    }
}

BufferPtr PackedMatrix::upload_table(std::span<const std::uint32_t> table, std::string_view what)
{
    const std::uint64_t wanted = std::max<std::uint64_t>(table.size_bytes(), 4);
    check_bytes(wanted, what);
    BufferPtr buffer = device_->make_buffer(wanted, what);
    if (!table.empty())
        device_->write<std::uint32_t>(buffer, table);
    bytes_ += table.size_bytes();
    return buffer;
}

void PackedMatrix::upload_values(const SparseMatrix& matrix, std::span<const std::uint32_t> slots,
                                 std::uint64_t count)
{
    const std::uint64_t bytes = count * real_bytes(precision_);
    check_bytes(bytes, "values");
    const auto send = [this](const auto& values, std::string_view label) {
        using Real = typename std::decay_t<decltype(values)>::value_type;
        BufferPtr buffer =
            device_->make_buffer(std::max<std::uint64_t>(values.size(), 1) * sizeof(Real), label);
        if (!values.empty())
            device_->write<Real>(buffer, values);
        bytes_ += values.size() * sizeof(Real);
        return buffer;
    };
    try
    {
        if (precision_ == Precision::float64)
        {
            values_ = send(pack<double>(matrix, slots, count, exponent_, false).values, "matrix values");
            return;
        }
        const Packed<float> packed = pack<float>(matrix, slots, count, exponent_, keeps_low_);
        values_ = send(packed.values, "matrix values");
        if (packed.needs_low)
            low_ = send(packed.low, "matrix low words");
    }
    catch (const std::bad_alloc&)
    {
        throw Error(ErrorCode::out_of_memory,
                    "format " + std::string(to_string(format_)) + " needs " + std::to_string(bytes) +
                        " bytes of the host for its values, which it does not have: "
                        "take a sparser format, or float");
    }
}

} // namespace taut::linear
