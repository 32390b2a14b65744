// Based on: kernels/linear/spmv_coo.comp and coo_carry.comp: a product is two dispatches.
// Departures: which rows several groups share, and which are empty, is found once on the host.

#include "taut/linear/device_formats.hpp"

#include "taut/kernels/coo_carry.hpp"
#include "taut/kernels/spmv_coo.hpp"

#include <numeric>

namespace taut::linear {
namespace {

constexpr std::uint64_t kTile = 7 * TAUT_LINEAR_GROUP; ///< entries of a round of spmv_coo
constexpr std::uint64_t kTripsOfTile = 24; ///< loading 7, adding 7, a scan of 7, and the round itself
constexpr const char* kCooLabel = "spmv";

class CooMatrix final : public PackedMatrix
{
public:
    CooMatrix(const std::shared_ptr<Device>& device, const SparseMatrix& matrix, const UploadOptions& options)
        : PackedMatrix(device, matrix, options),
          groups_(group_count_for(matrix.rows, device->info()))
    {
        check_entry_count(matrix.nonzeros(), "format coo");
        entries_ = make_grid(static_cast<std::uint32_t>(matrix.nonzeros()), groups_);
        check_trips();
        std::vector<std::uint32_t> row;
        row.reserve(matrix.value.size());
        for (std::uint32_t i = 0; i < matrix.rows; ++i)
            row.insert(row.end(), matrix.row_length(i), i);
        row_ = upload_table(row, "rows");
        column_ = upload_table(matrix.column, "columns");
        upload_carry_table(matrix);
        upload_values(matrix, slots(matrix), matrix.nonzeros());
        const std::uint64_t words = options.pairs ? 2 : 1;
        carries_ = device->make_buffer(2 * groups_ * words * real_bytes(precision()), "coo carries");
        if (options.pairs)
        {
            check_bytes(std::uint64_t{matrix.rows} * 8, "sums of rows");
            sums_ = device->make_buffer(std::uint64_t{matrix.rows} * 8, "coo sums");
        }
    }

    std::vector<std::uint32_t> slots(const SparseMatrix& matrix) const override
    {
        std::vector<std::uint32_t> out(matrix.value.size());
        std::iota(out.begin(), out.end(), 0u);
        return out;
    }

private:
    void check_trips() const;
    std::vector<std::uint32_t> carry_table(const SparseMatrix&);
    void upload_carry_table(const SparseMatrix&);
    void record(Recorder&, const Gate&, const Pass&) const override;

    const std::uint32_t groups_;
    std::uint32_t splits_ = 0;
    Grid entries_;
    BufferPtr row_, column_, table_, carries_, sums_;
};

void CooMatrix::check_trips() const
{
    const std::uint64_t trips = (entries_.chunk / kTile + 1) * kTripsOfTile;
    if (!device_->info().executor.starts_with("cpu") && trips > kMaxLoopTrips)
        throw Error(ErrorCode::limit, "format coo would make " + std::to_string(trips) + " loop trips for " +
                                          std::to_string(entries_.chunk) + " entries of a group, and " +
                                          std::to_string(kMaxLoopTrips) + " are safe: take csr");
}

/// As coo_carry.comp reads it.
std::vector<std::uint32_t> CooMatrix::carry_table(const SparseMatrix& matrix)
{
    const Grid grid = make_grid(matrix.rows, groups_);
    std::vector<std::uint32_t> table, empty_start, split, empty;
    for (std::uint32_t g = 0; g <= groups_; ++g)
    {
        table.push_back(static_cast<std::uint32_t>(split.size() / 3));
        empty_start.push_back(static_cast<std::uint32_t>(empty.size()));
        const std::uint64_t begin = std::uint64_t{g} * grid.chunk;
        for (std::uint64_t i = begin; i < std::min<std::uint64_t>(begin + grid.chunk, matrix.rows); ++i)
        {
            const auto row = static_cast<std::uint32_t>(i);
            if (matrix.row_length(row) == 0)
            {
                empty.push_back(row);
                continue;
            }
            const std::uint32_t first = matrix.row_start[row] / entries_.chunk;
            const std::uint32_t last = (matrix.row_start[row + 1] - 1) / entries_.chunk;
            if (first != last)
                split.insert(split.end(), {row, first, last});
        }
    }
    splits_ = static_cast<std::uint32_t>(split.size() / 3);
    for (const auto* part : {&empty_start, &split, &empty})
        table.insert(table.end(), part->begin(), part->end());
    return table;
}

/// Not counted as bytes of the matrix: a few words a group and one an empty row, as the groups have it.
void CooMatrix::upload_carry_table(const SparseMatrix& matrix)
{
    const std::vector<std::uint32_t> table = carry_table(matrix);
    check_bytes(table.size() * 4, "table of carries");
    table_ = device_->make_buffer(table.size() * 4, "coo table");
    device_->write<std::uint32_t>(table_, table);
}

void CooMatrix::record(Recorder& recorder, const Gate& gate, const Pass& pass) const
{
    if (gate.groups != groups_)
        throw Error(ErrorCode::bad_input, "format coo was packed for passes of " + std::to_string(groups_) +
                                              " groups (group_count_for), not of " +
                                              std::to_string(gate.groups));
    const bool pairs = pass.variant == "residual_pairs";
    if (pairs && !sums_)
        throw Error(ErrorCode::unsupported,
                    "this matrix was put on the device without `pairs`, so it forms no "
                    "residual in two floats");
    kernels::spmv_coo::Bindings<Binding> product = {
        .row = row_, .column = column_, .values = values(), .x = pass.x, .carries = carries_};
    kernels::coo_carry::Bindings<Binding> rest = {
        .table = table_, .carries = carries_, .y = pass.y, .partials = pass.partials, .b = pass.b};
    if (pairs)
    {
        product.sums = rest.sums = sums_;
        product.low = low_words();
    }
    else
        product.y = pass.y;
    if (pass.variant == "dot")
        rest.x = pass.x;
    launch(recorder, gate, {pairs ? pass.variant : "", precision(), kCooLabel}, product,
           {entries_.count, entries_.chunk, groups_, has_low_words() ? 1u : 0u});
    const Grid grid = make_grid(rows(), groups_);
    launch(recorder, gate, {pass.variant, precision(), kCooLabel}, rest,
           {grid.count, grid.chunk, groups_, splits_});
}

} // namespace

std::shared_ptr<DeviceMatrix> make_coo(const std::shared_ptr<Device>& device, const SparseMatrix& matrix,
                                       const UploadOptions& options)
{
    return std::make_shared<CooMatrix>(device, matrix, options);
}

} // namespace taut::linear
