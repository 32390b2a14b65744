#pragma once
// What every matrix that a reader lets through must keep: for the mutation test and the fuzz target.

#include "taut/linear/sparse.hpp"

#include <cmath>
#include <stdexcept>

namespace taut::linear {

/// Throws std::logic_error naming the broken promise.
inline void require_sound(const SparseMatrix& a)
{
    const auto require = [](bool good, const char* promise) {
        if (!good)
            throw std::logic_error(promise);
    };
    require(a.row_start.size() == std::size_t(a.rows) + 1, "row_start does not have rows + 1 entries");
    require(a.row_start.front() == 0 && a.row_start.back() == a.column.size(),
            "row_start does not span the entries");
    require(a.value.size() == a.column.size(), "values and columns differ in number");
    for (std::uint32_t i = 0; i < a.rows; ++i)
    {
        require(a.row_start[i] <= a.row_start[i + 1], "row_start descends");
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            require(a.column[k] < a.columns, "a column is out of range");
            require(k == a.row_start[i] || a.column[k - 1] < a.column[k], "columns of a row do not ascend");
            require(std::isfinite(a.value[k]), "a value is not finite");
        }
    }
}

} // namespace taut::linear
