// Based on: kernels/linear/spmv_bcsr3.comp and kernels/shared/bcsr3.h.
// Departures: none.

#include "taut/linear/bcsr3.hpp"

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/spmv_bcsr3.hpp"

#include <algorithm>

namespace taut::linear {
namespace {

constexpr std::uint32_t kBlockSlice = TAUT_BCSR3_SLICE;

/// Columns of the blocks of one block row, ascending.
std::vector<std::uint32_t> block_columns(const SparseMatrix& matrix, std::uint32_t block_row)
{
    std::vector<std::uint32_t> columns;
    for (std::uint32_t k = matrix.row_start[3 * block_row]; k < matrix.row_start[3 * block_row + 3]; ++k)
        columns.push_back(matrix.column[k] / 3);
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    return columns;
}

class Bcsr3Matrix final : public PackedMatrix
{
public:
    Bcsr3Matrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                const UploadOptions& options)
        : PackedMatrix(device, matrix, options),
          layout_(bcsr3_layout(matrix))
    {
        check_bytes(layout_.values() * real_bytes(precision()), "values");
        check_trips();
        slice_start_ = upload_table(layout_.slice_start, "slices");
        column_ = upload_table(layout_.column, "columns of blocks");
        upload_values(matrix, slots(matrix), layout_.values());
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        return bcsr3_slots(matrix, layout_);
    }

private:
    void check_trips() const;
    void record(Recorder&, const Gate&, const Pass&) const override;
    Grid grid(std::uint32_t groups) const { return make_grid(rows() / 3, groups, kBlockSlice); }

    const Bcsr3Layout layout_;
    BufferPtr slice_start_, column_;
};

/// Four slices run side by side: a lane makes at most the steps of the longest of each four.
void Bcsr3Matrix::check_trips() const
{
    if (device_->info().executor.starts_with("cpu"))
        return; // a CPU's loops may run as long as they like
    const std::uint32_t slices_of_group = grid(group_count_for(rows(), device_->info())).chunk / kBlockSlice;
    const auto slices = static_cast<std::uint32_t>(layout_.slice_start.size() - 1);
    for (std::uint32_t first = 0; first < slices; first += slices_of_group)
    {
        std::uint64_t trips[TAUT_LINEAR_GROUP / kBlockSlice] = {};
        for (std::uint32_t s = first; s < std::min(slices, first + slices_of_group); ++s)
            trips[(s - first) % std::size(trips)] += layout_.slice_start[s + 1] - layout_.slice_start[s] + 2;
        const std::uint64_t most = *std::max_element(std::begin(trips), std::end(trips));
        if (most > kMaxLoopTrips)
            throw Error(ErrorCode::limit, "format bcsr3 would make " + std::to_string(most) +
                                              " loop trips from block row " +
                                              std::to_string(first * kBlockSlice) + " on, and " +
                                              std::to_string(kMaxLoopTrips) + " are safe: take csr or coo");
    }
}

void Bcsr3Matrix::record(Recorder& recorder, const Gate& gate, const Pass& pass) const
{
    const Grid share = grid(gate.groups);
    launch(recorder, gate, {pass.variant, precision(), "spmv"},
           bindings(kernels::spmv_bcsr3::Bindings<Binding>{.slice_start = slice_start_, .column = column_},
                    pass),
           {share.count, share.chunk, gate.groups, has_low_words() ? 1u : 0u});
}

} // namespace

Bcsr3Layout bcsr3_layout(const SparseMatrix& matrix)
{
    if (matrix.rows % 3 != 0 || matrix.columns % 3 != 0)
        throw Error(ErrorCode::bad_input,
                    "format bcsr3 needs a multiple of 3 rows and columns, but there are " +
                        std::to_string(matrix.rows) + " and " + std::to_string(matrix.columns) +
                        ": take csr or sell");
    const std::uint32_t block_rows = matrix.rows / 3;
    Bcsr3Layout layout;
    layout.slice_start.push_back(0);
    for (std::uint32_t first = 0; first < block_rows; first += kBlockSlice)
    {
        std::vector<std::vector<std::uint32_t>> rows;
        std::size_t longest = 0;
        for (std::uint32_t i = first; i < std::min(block_rows, first + kBlockSlice); ++i)
        {
            rows.push_back(block_columns(matrix, i));
            longest = std::max(longest, rows.back().size());
        }
        for (std::size_t k = 0; k < longest; ++k)
            for (std::uint32_t r = 0; r < kBlockSlice; ++r)
            {
                const bool there = r < rows.size() && k < rows[r].size();
                layout.column.push_back(there ? rows[r][k] : std::min(first + r, block_rows - 1));
            }
        check_entry_count(layout.values(), "format bcsr3");
        layout.slice_start.push_back(static_cast<std::uint32_t>(layout.column.size() / kBlockSlice));
    }
    return layout;
}

std::vector<std::uint32_t> bcsr3_slots(const SparseMatrix& matrix, const Bcsr3Layout& layout)
{
    std::vector<std::uint32_t> out;
    out.reserve(matrix.value.size());
    std::vector<std::uint32_t> columns;
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
    {
        const std::uint32_t block_row = row / 3;
        if (row % 3 == 0)
            columns = block_columns(matrix, block_row);
        for (std::uint32_t k = matrix.row_start[row]; k < matrix.row_start[row + 1]; ++k)
        {
            const auto at = std::lower_bound(columns.begin(), columns.end(), matrix.column[k] / 3);
            const auto step = layout.slice_start[block_row / kBlockSlice] +
                              static_cast<std::uint32_t>(at - columns.begin());
            out.push_back(bcsr3_value(step, row % 3 * 3 + matrix.column[k] % 3, block_row % kBlockSlice));
        }
    }
    return out;
}

std::shared_ptr<DeviceMatrix> make_bcsr3(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                         const UploadOptions& options)
{
    return std::make_shared<Bcsr3Matrix>(device, matrix, options);
}

} // namespace taut::linear
