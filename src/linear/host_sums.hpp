#pragma once
// Sums on the host that several methods share. Internal.
// Based on: Gershgorin. Über die Abgrenzung der Eigenwerte einer Matrix. 1931.
// Departures: none.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace taut::linear {

/// In order, without care for overflow.
inline double dot(std::span<const double> a, std::span<const double> b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i] * b[i];
    return sum;
}

/// max over rows of sum_j |a_ij| m_i: no eigenvalue of D^-1 A is larger. Compressed rows as `start` (rows +
/// 1), `column` and `value`; m is `inverse`, one value a row, and rows and columns where it is 0 are left
/// out.
template <typename Index>
double gershgorin(std::span<const Index> start, std::span<const Index> column, std::span<const double> value,
                  std::span<const double> inverse)
{
    double most = 0;
    for (std::size_t i = 0; i < inverse.size(); ++i)
    {
        double sum = 0;
        for (auto k = static_cast<std::size_t>(start[i]); k < static_cast<std::size_t>(start[i + 1]); ++k)
            sum += inverse[static_cast<std::size_t>(column[k])] > 0 ? std::abs(value[k]) * inverse[i] : 0;
        most = std::max(most, sum);
    }
    return most;
}

} // namespace taut::linear
