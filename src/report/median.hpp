#pragma once
// Internal to src/report.

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace taut {

/// The value that a share of `values` lies below, 0 <= share < 1: no mean of two; 0 of none.
inline double quantile(std::vector<double> values, double share)
{
    if (values.empty())
        return 0;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The median of `values`, of an even count the upper of the two in the middle; 0 of none.
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

} // namespace taut
