#pragma once
// Internal to src/report.

#include <algorithm>
#include <vector>

namespace taut {

/// The median of `values`, of an even count the upper of the two in the middle; 0 of none.
inline double median(std::vector<double> values)
{
    if (values.empty())
        return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace taut
