#pragma once
// What tests of formats have in common.

#include "taut/linear/device_matrix.hpp"

#include <initializer_list>
#include <utility>
#include <vector>

namespace taut::linear::formats_test {

/// Diagonal, with `full` rows and columns that hold every entry, or `share` of it.
inline SparseMatrix arrow(std::uint32_t rows,
                          std::initializer_list<std::pair<std::uint32_t, std::uint32_t>> full)
{
    std::vector<Triplet> triplets;
    for (std::uint32_t i = 0; i < rows; ++i)
        triplets.push_back({i, i, 4.0 + i % 3});
    for (const auto& [row, count] : full)
        for (std::uint32_t j = 0; j < count; ++j)
            if (j != row)
            {
                triplets.push_back({row, j, 1.0 / (1 + j % 17)});
                triplets.push_back({j, row, 1.0 / (1 + j % 17)});
            }
    return from_triplets(rows, rows, triplets);
}

inline std::vector<Format> formats()
{
    return {Format::dense, Format::coo, Format::csr, Format::ell, Format::sell, Format::bcsr3};
}

} // namespace taut::linear::formats_test
