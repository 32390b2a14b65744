#include "taut/world/split_costs.hpp"

#include <algorithm>

namespace taut {
namespace {

constexpr double kWorthSplitting = 0.9; ///< share of the faster device's time that a split must promise

} // namespace

double split_ms(const SplitCosts& costs, double share)
{
    const double apart = std::max(share * costs.first_ms, (1 - share) * costs.second_ms);
    return apart + (share > 0 && share < 1 ? static_cast<double>(costs.exchanges) * costs.exchange_ms : 0);
}

double even_share(const SplitCosts& costs)
{
    const double both = costs.first_ms + costs.second_ms;
    return both > 0 ? costs.second_ms / both : 0.5;
}

double best_share(const SplitCosts& costs)
{
    const double alone = costs.first_ms <= costs.second_ms ? 1 : 0;
    const double even = even_share(costs);
    return split_ms(costs, even) < kWorthSplitting * split_ms(costs, alone) ? even : alone;
}

} // namespace taut
