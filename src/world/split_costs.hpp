#pragma once
// What it costs to step one scene on two devices, as a model.

#include <cstdint>

namespace taut {

/// What a step of a scene takes on two devices; all as measured on halves of it.
struct SplitCosts
{
    double first_ms = 0, second_ms = 0; ///< of the whole scene on each device alone
    double exchange_ms = 0;             ///< of one exchange
    std::uint64_t exchanges = 0;        ///< of a step
};

/// The model: both work at the same time on their shares, then exchange [ms a step],
///   t(s) = max(s t_first, (1 - s) t_second) + exchanges * t_exchange, without exchanges for s = 0 and s = 1.
/// `share` is that of the first device, 0 to 1.
double split_ms(const SplitCosts& costs, double share);

/// The share at which both end together, t_second / (t_first + t_second): the least of the model within (0,
/// 1).
double even_share(const SplitCosts& costs);

/// even_share, or 0 or 1 where the model promises less than a tenth by splitting.
double best_share(const SplitCosts& costs);

} // namespace taut
