// Based on: kernels/linear/spmv_csr.comp and spmv_csr_long.comp.
// Departures: entries of long rows stand behind all others, so that the kernel of short rows sees those rows
// without entries; a row that is empty in truth holds one zero on its diagonal.

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/spmv_csr.hpp"
#include "taut/kernels/spmv_csr_long.hpp"

#include <algorithm>

namespace taut::linear {
namespace {

constexpr const char* kCsrLabel = "spmv";

struct Layout
{
    std::vector<std::uint32_t> row_start; ///< of short rows
    std::vector<std::uint32_t> long_rows; ///< three words each: row, first entry, one behind the last
    std::vector<std::uint32_t> slots;     ///< of the matrix' entries
    std::uint64_t count = 0;              ///< entries stored
};

Layout lay_out(const SparseMatrix& matrix)
{
    Layout layout;
    layout.row_start.push_back(0);
    layout.slots.resize(matrix.value.size());
    std::uint32_t at = 0;
    const auto place = [&](std::uint32_t row) {
        for (std::uint32_t k = matrix.row_start[row]; k < matrix.row_start[row + 1]; ++k)
            layout.slots[k] = at++;
    };
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
    {
        if (matrix.row_length(row) <= kLongRow)
            place(row);
        at += matrix.row_length(row) == 0 ? 1 : 0;
        layout.row_start.push_back(at);
    }
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
        if (matrix.row_length(row) > kLongRow)
        {
            layout.long_rows.insert(layout.long_rows.end(), {row, at, at + matrix.row_length(row)});
            place(row);
        }
    layout.count = at;
    return layout;
}

std::vector<std::uint32_t> columns_of(const SparseMatrix& matrix, const Layout& layout)
{
    std::vector<std::uint32_t> column(layout.count);
    for (std::size_t k = 0; k < layout.slots.size(); ++k)
        column[layout.slots[k]] = matrix.column[k];
    for (std::uint32_t row = 0; row < matrix.rows; ++row)
        if (matrix.row_length(row) == 0)
            column[layout.row_start[row]] = std::min(row, matrix.columns - 1); // x may be shorter
    return column;
}

/// Trips of one lane of spmv_csr_long for a row of `length` entries, with the tree of sums.
std::uint64_t long_trips(std::uint64_t length) { return length / TAUT_LINEAR_GROUP + 10; }

class CsrMatrix final : public PackedMatrix
{
public:
    CsrMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix, const UploadOptions& options)
        : PackedMatrix(device, matrix, options),
          // On the CPU straight from memory, elsewhere through shared memory: the same bits.
          stream_(!is_native())
    {
        check_entry_count(matrix.nonzeros() + matrix.rows, "format csr"); // an empty row holds a zero
        const Layout layout = lay_out(matrix);
        check_short_rows(layout);
        cut_long_rows(layout);
        row_start_ = upload_table(layout.row_start, "row starts");
        column_ = upload_table(columns_of(matrix, layout), "columns");
        if (!layout.long_rows.empty())
            long_rows_ = upload_table(layout.long_rows, "long rows");
        upload_values(matrix, layout.slots, layout.count);
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        return lay_out(matrix).slots;
    }

private:
    void record(Recorder&, const Gate&, const Pass&) const override;
    void check_short_rows(const Layout&) const;
    void cut_long_rows(const Layout&);

    const bool stream_;
    BufferPtr row_start_, column_, long_rows_;
    std::vector<std::uint32_t> cuts_; ///< dispatches of spmv_csr_long: rows cuts_[k] up to cuts_[k + 1]
};

/// A window of 128 rows passes through shared memory in pieces; the longest row of it is the busiest lane's.
void CsrMatrix::check_short_rows(const Layout& layout) const
{
    check_trips(rows(), [&](std::uint32_t begin, std::uint32_t end) {
        std::uint32_t longest = 0;
        for (std::uint32_t row = begin; row < end; ++row)
            longest = std::max(longest, layout.row_start[row + 1] - layout.row_start[row]);
        return (layout.row_start[end] - layout.row_start[begin]) / 64 + longest + 4;
    });
}

/// Long rows go round among the groups; as many dispatches as keep every group below the trips there may be.
void CsrMatrix::cut_long_rows(const Layout& layout)
{
    const std::uint32_t groups = group_count_for(rows(), device_->info());
    const auto count = static_cast<std::uint32_t>(layout.long_rows.size() / 3);
    std::vector<std::uint64_t> trips(groups, 0);
    cuts_.assign(1, 0);
    for (std::uint32_t k = 0; k < count; ++k)
    {
        const std::uint64_t length = layout.long_rows[3 * k + 2] - layout.long_rows[3 * k + 1];
        if (length > kLongestCsrRow)
            throw Error(ErrorCode::limit, "row " + std::to_string(layout.long_rows[3 * k]) +
                                              " (from 0) holds " + std::to_string(length) +
                                              " entries, and a row of format csr may hold " +
                                              std::to_string(kLongestCsrRow) + ": take coo");
        std::uint64_t& sum = trips[(k - cuts_.back()) % groups];
        if (sum + long_trips(length) > kMaxLoopTrips)
        {
            cuts_.push_back(k);
            std::fill(trips.begin(), trips.end(), 0);
            trips[0] = long_trips(length);
            continue;
        }
        sum += long_trips(length);
    }
    if (count > 0)
        cuts_.push_back(count);
}

void CsrMatrix::record(Recorder& recorder, const Gate& gate, const Pass& pass) const
{
    const std::uint32_t low_words = has_low_words() ? 1 : 0;
    for (std::size_t k = 1; k < cuts_.size(); ++k)
    {
        Pass plain = pass;
        if (pass.variant == "dot") // taken from y by the short rows
            plain.variant = "";
        launch(recorder, gate, {plain.variant, precision(), kCsrLabel},
               bindings(kernels::spmv_csr_long::Bindings<Binding>{.long_rows = long_rows_, .column = column_},
                        plain),
               {cuts_[k - 1], cuts_[k], gate.groups, low_words});
    }
    std::string variant(pass.variant);
    if (stream_)
        variant = variant.empty() ? "stream" : "stream_" + variant;
    const Grid grid = make_grid(rows(), gate.groups);
    launch(recorder, gate, {variant, precision(), kCsrLabel},
           bindings(kernels::spmv_csr::Bindings<Binding>{.row_start = row_start_, .column = column_}, pass),
           {grid.count, grid.chunk, gate.groups, low_words});
}

} // namespace

std::shared_ptr<DeviceMatrix> make_csr(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                       const UploadOptions& options)
{
    return std::make_shared<CsrMatrix>(device, matrix, options);
}

} // namespace taut::linear
