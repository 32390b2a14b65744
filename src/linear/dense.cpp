// Based on: kernels/linear/spmv_dense.comp.
// Departures: none.

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/spmv_dense.hpp"

namespace taut::linear {
namespace {

constexpr std::uint32_t kMostDenseRows = 65535; ///< so that entries can be numbered by 32 bits

class DenseMatrix final : public PackedMatrix
{
public:
    DenseMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                const UploadOptions& options)
        : PackedMatrix(device, matrix, options)
    {
        const std::uint64_t count = std::uint64_t{matrix.rows} * matrix.rows;
        check_bytes(count * real_bytes(precision()),
                    std::to_string(matrix.rows) + " x " + std::to_string(matrix.rows) + " values");
        if (matrix.rows > kMostDenseRows)
            throw Error(ErrorCode::limit, "format dense numbers the entries of at most " +
                                              std::to_string(kMostDenseRows) + " rows, but there are " +
                                              std::to_string(matrix.rows) + ": take a sparser format");
        check_trips();
        upload_values(matrix, slots(matrix), count);
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        std::vector<std::uint32_t> out;
        out.reserve(matrix.value.size());
        for (std::uint32_t row = 0; row < matrix.rows; ++row)
            for (std::uint32_t k = matrix.row_start[row]; k < matrix.row_start[row + 1]; ++k)
                out.push_back(row * matrix.rows + matrix.column[k]);
        return out;
    }

private:
    void check_trips() const;
    void record(Recorder&, const Gate&, const Pass&) const override;
};

/// A lane's loops over the rows of its group: its columns, and the tree of sums.
void DenseMatrix::check_trips() const
{
    if (device_->info().executor.starts_with("cpu"))
        return; // a CPU's loops may run as long as they like
    const Grid grid = make_grid(rows(), group_count_for(rows(), device_->info()));
    const std::uint64_t trips = std::uint64_t{grid.chunk} * (rows() / TAUT_LINEAR_GROUP + 9);
    if (trips > kMaxLoopTrips)
        throw Error(ErrorCode::limit, "format dense would make " + std::to_string(trips) + " loop trips in " +
                                          std::to_string(grid.chunk) + " rows of " + std::to_string(rows()) +
                                          " entries, and " + std::to_string(kMaxLoopTrips) +
                                          " are safe: take a sparser format");
}

void DenseMatrix::record(Recorder& recorder, const Gate& gate, const Pass& pass) const
{
    const Grid grid = make_grid(rows(), gate.groups);
    launch(recorder, gate, {pass.variant, precision(), "spmv"},
           bindings(kernels::spmv_dense::Bindings<Binding>{}, pass),
           {grid.count, grid.chunk, gate.groups, has_low_words() ? 1u : 0u});
}

} // namespace

std::shared_ptr<DeviceMatrix> make_dense(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                         const UploadOptions& options)
{
    return std::make_shared<DenseMatrix>(device, matrix, options);
}

} // namespace taut::linear
