// Based on: kernels/linear/spmv_ell.comp.
// Departures: none.

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/spmv_ell.hpp"

#include <algorithm>

namespace taut::linear {
namespace {

constexpr std::uint32_t kRowMultiple = 32; ///< columns of storage begin at whole cache lines

class EllMatrix final : public PackedMatrix
{
public:
    EllMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix, const UploadOptions& options)
        : PackedMatrix(device, matrix, options),
          stride_((matrix.rows + kRowMultiple - 1) / kRowMultiple * kRowMultiple)
    {
        for (std::uint32_t row = 0; row < matrix.rows; ++row)
            width_ = std::max(width_, matrix.row_length(row));
        check_entry_count(std::uint64_t{stride_} * width_, "format ell");
        const std::uint64_t stored = std::uint64_t{stride_} * width_;
        check_bytes(stored * std::max(real_bytes(precision()), 4u), "entries");
        check_trips(rows(), [this](std::uint32_t, std::uint32_t) { return width_; });
        column_ = upload_table(columns_of(matrix), "columns");
        upload_values(matrix, slots(matrix), stored);
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        std::vector<std::uint32_t> slots;
        slots.reserve(matrix.value.size());
        for (std::uint32_t row = 0; row < matrix.rows; ++row)
            for (std::uint32_t k = 0; k < matrix.row_length(row); ++k)
                slots.push_back(k * stride_ + row);
        return slots;
    }

private:
    /// Padding is in the row's own column.
    std::vector<std::uint32_t> columns_of(const SparseMatrix& matrix) const
    {
        std::vector<std::uint32_t> column(std::size_t{stride_} * width_);
        for (std::uint32_t row = 0; row < matrix.rows; ++row)
            for (std::uint32_t k = 0; k < width_; ++k)
                column[std::size_t{k} * stride_ + row] =
                    k < matrix.row_length(row) ? matrix.column[matrix.row_start[row] + k] : row;
        return column;
    }

    void record(Recorder& recorder, const Gate& gate, const Pass& pass) const override
    {
        const Grid grid = make_grid(rows(), gate.groups);
        launch(recorder, gate, {pass.variant, precision(), "spmv"},
               bindings(kernels::spmv_ell::Bindings<Binding>{.column = column_}, pass),
               {grid.count, grid.chunk, gate.groups, stride_, width_, has_low_words() ? 1u : 0u});
    }

    const std::uint32_t stride_;
    std::uint32_t width_ = 0;
    BufferPtr column_;
};

} // namespace

std::shared_ptr<DeviceMatrix> make_ell(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                       const UploadOptions& options)
{
    return std::make_shared<EllMatrix>(device, matrix, options);
}

} // namespace taut::linear
