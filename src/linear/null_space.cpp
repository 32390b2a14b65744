// Based on: Golub, Van Loan. Matrix Computations, 4th ed., 5.2.8 (modified Gram-Schmidt, here done twice).
// Departures: none.

#include "taut/linear/null_space.hpp"

#include "taut/linear/host_sums.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"

#include <algorithm>
#include <cmath>

namespace taut::linear {
namespace {

void subtract(std::span<double> v, double factor, std::span<const double> z)
{
    for (std::size_t i = 0; i < v.size(); ++i)
        v[i] -= factor * z[i];
}

double row_sum_norm(const SparseMatrix& a)
{
    double largest = 0;
    for (std::uint32_t row = 0; row < a.rows; ++row)
    {
        double sum = 0;
        for (std::uint32_t k = a.row_start[row]; k < a.row_start[row + 1]; ++k)
            sum += std::abs(a.value[k]);
        largest = std::max(largest, sum);
    }
    return largest;
}

void check_vector(const SparseMatrix& a, std::span<const double> z, std::size_t index, double size)
{
    const std::string name = "null vector " + std::to_string(index + 1);
    if (z.size() != a.rows)
        throw Error(ErrorCode::bad_input, name + " has " + counted(z.size(), "entry", "entries") +
                                              ", but A has " + counted(a.rows, "row", "rows"));
    if (!(norm(z) > 0) || !std::isfinite(norm(z)))
        throw Error(ErrorCode::bad_input, name + " must be finite and not zero");
    std::vector<double> image(z.size());
    multiply(a, z, image);
    double largest = 0, entry = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
    {
        largest = std::max(largest, std::abs(image[i]));
        entry = std::max(entry, std::abs(z[i]));
    }
    if (largest > 1e-8 * size * entry)
        throw Error(ErrorCode::bad_input, name + " is not in the null space: |A z| is " + shown(largest) +
                                              " where at most 1e-8 |A| |z| = " + shown(1e-8 * size * entry) +
                                              " is rounding");
}

} // namespace

NullBasis::NullBasis(const SparseMatrix& a, NullSpace kind, std::span<const std::vector<double>> given)
{
    if (kind == NullSpace::none || a.rows == 0)
        return;
    const std::vector<std::vector<double>> constant = {std::vector<double>(a.rows, 1.0)};
    if (kind == NullSpace::constants)
        given = constant;
    const double size = row_sum_norm(a);
    for (std::size_t k = 0; k < given.size(); ++k)
    {
        check_vector(a, given[k], k, size);
        std::vector<double> z = given[k];
        const double before = norm(z);
        for (double& entry : z)
            entry /= before;
        project(z);
        project(z);
        const double left = norm(z);
        if (left < 1e-6)
            throw Error(ErrorCode::bad_input, "null vector " + std::to_string(k + 1) +
                                                  " depends on the ones before it: leave it out");
        for (double& entry : z)
            entry /= left;
        vectors_.push_back(std::move(z));
    }
}

double NullBasis::project(std::span<double> v) const
{
    double taken = 0;
    for (const std::vector<double>& z : vectors_)
    {
        const double part = dot(v, z);
        subtract(v, part, z);
        taken += part * part;
    }
    return std::sqrt(taken);
}

} // namespace taut::linear
