#include "taut/linear/device_matrix.hpp"

#include "taut/linear/check.hpp"
#include "taut/linear/device_formats.hpp"
#include "taut/runtime/required.hpp"

#include <algorithm>
#include <cmath>

namespace taut::linear {
namespace {

void check(const Device& device, const SparseMatrix& matrix, const UploadOptions& options)
{
    check_row_count(std::max(matrix.rows, matrix.columns)); // before anything is done for each of them
    check_structure(matrix);
    const bool may_be_long = options.rectangular && options.format == Format::csr;
    if (matrix.rows != matrix.columns && !may_be_long)
        throw Error(ErrorCode::bad_input,
                    "the matrix has " + std::to_string(matrix.rows) + " rows and " +
                        std::to_string(matrix.columns) +
                        " columns: only square ones go to a device, or rectangular ones in csr");
    if (matrix.rows == 0)
        throw Error(ErrorCode::bad_input, "the matrix has no rows: nothing to put on a device");
    if (options.precision == Precision::float64)
        require_float64(device.info());
    if (options.pairs && options.precision != Precision::float32)
        throw Error(ErrorCode::bad_input, "low words are kept of floats only: take pairs with float");
}

} // namespace

int DeviceMatrix::scale_exponent(const SparseMatrix& matrix)
{
    double largest = 0;
    for (const double value : matrix.value)
        if (std::isfinite(value))
            largest = std::max(largest, std::abs(value));
    return largest > 0 ? -std::ilogb(largest) : 0;
}

std::shared_ptr<DeviceMatrix> DeviceMatrix::upload(const std::shared_ptr<Device>& device,
                                                   const SparseMatrix& matrix, const UploadOptions& options)
{
    check(*required(device, "DeviceMatrix::upload"), matrix, options);
    switch (options.format)
    {
    case Format::automatic: break;
    case Format::csr: return make_csr(device, matrix, options);
    case Format::ell: return make_ell(device, matrix, options);
    case Format::sell: return make_sell(device, matrix, options);
    case Format::dense: return make_dense(device, matrix, options);
    case Format::coo: return make_coo(device, matrix, options);
    case Format::bcsr3: return make_bcsr3(device, matrix, options);
    }
    throw Error(ErrorCode::bad_input, "a format is wanted, not \"auto\": ask choose_format first");
}

} // namespace taut::linear
