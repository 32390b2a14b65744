// Based on: kernels/linear/spmv_sell.comp.
// Departures: none.

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/spmv_sell.hpp"

#include <algorithm>
#include <numeric>

namespace taut::linear {
namespace {

constexpr std::uint32_t kSlice = SellLayout::kSlice;

class SellMatrix final : public PackedMatrix
{
public:
    SellMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
               const UploadOptions& options)
        : PackedMatrix(device, matrix, options)
    {
        const SellLayout layout = sell_layout(matrix);
        check_entry_count(layout.entries(), "format sell");
        check_bytes(layout.entries() * std::max(real_bytes(precision()), 4u), "entries");
        check_trips(rows(), [&](std::uint32_t begin, std::uint32_t end) {
            std::uint64_t widest = 0;
            for (std::uint32_t slice = begin / kSlice; slice * kSlice < end; ++slice)
                widest =
                    std::max(widest, (layout.slice_start[slice + 1] - layout.slice_start[slice]) / kSlice);
            return widest;
        });
        slice_start_ = upload_table(
            std::vector<std::uint32_t>(layout.slice_start.begin(), layout.slice_start.end()), "slice starts");
        order_ = upload_table(layout.order, "order of rows");
        column_ = upload_table(columns_of(matrix, layout), "columns");
        upload_values(matrix, slots_of(matrix, layout), layout.entries());
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        return slots_of(matrix, sell_layout(matrix));
    }

private:
    static std::uint32_t first_slot(const SellLayout& layout, std::uint32_t place)
    {
        return static_cast<std::uint32_t>(layout.slice_start[place / kSlice] + place % kSlice);
    }

    static std::vector<std::uint32_t> slots_of(const SparseMatrix& matrix, const SellLayout& layout)
    {
        std::vector<std::uint32_t> slots(matrix.value.size());
        for (std::uint32_t place = 0; place < matrix.rows; ++place)
        {
            const std::uint32_t row = layout.order[place];
            for (std::uint32_t k = 0; k < matrix.row_length(row); ++k)
                slots[matrix.row_start[row] + k] = first_slot(layout, place) + k * kSlice;
        }
        return slots;
    }

    /// Padding is in the row's own column.
    static std::vector<std::uint32_t> columns_of(const SparseMatrix& matrix, const SellLayout& layout)
    {
        std::vector<std::uint32_t> column(layout.entries());
        for (std::uint32_t place = 0; place < matrix.rows; ++place)
        {
            const std::uint32_t row = layout.order[place];
            const std::uint64_t after = layout.slice_start[place / kSlice + 1];
            for (std::uint64_t at = first_slot(layout, place), k = 0; at < after; at += kSlice, ++k)
                column[at] = k < matrix.row_length(row) ? matrix.column[matrix.row_start[row] + k] : row;
        }
        return column;
    }

    void record(Recorder& recorder, const Gate& gate, const Pass& pass) const override
    {
        const Grid grid = make_grid(rows(), gate.groups);
        launch(recorder, gate, {pass.variant, precision(), "spmv"},
               bindings(kernels::spmv_sell::Bindings<Binding>{.slice_start = slice_start_,
                                                              .order = order_,
                                                              .column = column_},
                        pass),
               {grid.count, grid.chunk, gate.groups, has_low_words() ? 1u : 0u});
    }

    BufferPtr slice_start_, order_, column_;
};

} // namespace

SellLayout sell_layout(const SparseMatrix& matrix)
{
    SellLayout layout;
    layout.order.resize(matrix.rows);
    std::iota(layout.order.begin(), layout.order.end(), 0u);
    for (std::uint32_t begin = 0; begin < matrix.rows;
         begin += std::min(SellLayout::kWindow, matrix.rows - begin))
    {
        const std::uint32_t end = begin + std::min(SellLayout::kWindow, matrix.rows - begin);
        std::stable_sort(
            layout.order.begin() + begin, layout.order.begin() + end,
            [&](std::uint32_t a, std::uint32_t b) { return matrix.row_length(a) > matrix.row_length(b); });
    }
    layout.slice_start.push_back(0);
    for (std::uint64_t place = 0; place < matrix.rows; place += kSlice) // the first of a slice is its longest
        layout.slice_start.push_back(layout.slice_start.back() +
                                     std::uint64_t{kSlice} * matrix.row_length(layout.order[place]));
    return layout;
}

std::shared_ptr<DeviceMatrix> make_sell(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                        const UploadOptions& options)
{
    return std::make_shared<SellMatrix>(device, matrix, options);
}

} // namespace taut::linear
