// Based on: kernels/linear/diagonal_inverse.comp.
// Departures: none.

#include "taut/linear/device_inverse.hpp"

#include "taut/kernels/diagonal_inverse.hpp"
#include "taut/linear/check.hpp"

#include <string>

namespace taut::linear {
namespace {

constexpr std::uint32_t kMissing = 0xffffffffu; ///< an entry that is not stored

/// Where the diagonal is in values(): a word a row, or nine a block row.
std::vector<std::uint32_t> table_of(const SparseMatrix& pattern, std::span<const std::uint32_t> slots,
                                    bool blocks)
{
    std::vector<std::uint32_t> table(std::size_t{pattern.rows} * (blocks ? 3 : 1), kMissing);
    for (std::uint32_t row = 0; row < pattern.rows; ++row)
        for (std::uint32_t k = pattern.row_start[row]; k < pattern.row_start[row + 1]; ++k)
        {
            const std::uint32_t column = pattern.column[k];
            if (blocks && column / 3 == row / 3)
                table[std::size_t{row} * 3 + column % 3] = slots[k];
            else if (!blocks && column == row)
                table[row] = slots[k];
        }
    return table;
}

void check(const DeviceMatrix& matrix, const SparseMatrix& pattern, Preconditioner kind,
           const BufferPtr& held)
{
    check_structure(pattern);
    if (pattern.rows != matrix.rows() || pattern.columns != pattern.rows)
        throw Error(ErrorCode::bad_input, "the pattern is of " + std::to_string(pattern.rows) + " x " +
                                              std::to_string(pattern.columns) +
                                              " entries, but the matrix on the device has " +
                                              std::to_string(matrix.rows()) + " rows");
    if (kind != Preconditioner::jacobi && kind != Preconditioner::block_jacobi)
        throw Error(ErrorCode::unsupported, "the inverse of \"" + std::string(to_string(kind)) +
                                                "\" is not formed on a device: take jacobi or block_jacobi");
    if (kind == Preconditioner::block_jacobi && pattern.rows % 3 != 0)
        throw Error(ErrorCode::bad_input, "block_jacobi needs a multiple of 3 rows, but there are " +
                                              std::to_string(pattern.rows) + ": take jacobi");
    if (held && held->bytes() < std::uint64_t{pattern.rows} * 4)
        throw Error(ErrorCode::bad_input, "the buffer of held rows has " + std::to_string(held->bytes()) +
                                              " bytes, but " + std::to_string(pattern.rows) +
                                              " rows take 4 bytes each");
}

} // namespace

DeviceInverse::DeviceInverse(std::shared_ptr<Device> device, std::shared_ptr<const DeviceMatrix> matrix,
                             const SparseMatrix& pattern, Preconditioner kind, BufferPtr held)
    : matrix_(std::move(matrix)),
      kind_(kind),
      held_(std::move(held))
{
    check(*matrix_, pattern, kind_, held_);
    const bool blocks = kind_ == Preconditioner::block_jacobi;
    const std::uint64_t rows = pattern.rows;
    const std::vector<std::uint32_t> table = table_of(pattern, matrix_->slots(pattern), blocks);
    slots_ = device->make_buffer(table.size() * 4, "slots of the diagonal");
    device->write<std::uint32_t>(slots_, table);
    if (!held_)
        held_ = device->make_buffer(rows * 4, "no held rows"); // zeros
    inverse_ = device->make_buffer(rows * (blocks ? 2 : 1) * real_bytes(matrix_->precision()), "cg inverse");
}

void DeviceInverse::record(Recorder& recorder, const Gate& gate) const
{
    const bool blocks = kind_ == Preconditioner::block_jacobi;
    const Grid grid = make_grid(blocks ? matrix_->rows() / 3 : matrix_->rows(), gate.groups);
    launch(recorder, gate, {blocks ? "block" : "", matrix_->precision(), "cg inverse"},
           kernels::diagonal_inverse::Bindings<Recorder::Binding>{
               .values = matrix_->values(), .slots = slots_, .held = held_, .inverse = inverse_},
           {grid.count, grid.chunk});
}

std::uint64_t DeviceInverse::bytes() const { return slots_->bytes() + held_->bytes() + inverse_->bytes(); }

} // namespace taut::linear
