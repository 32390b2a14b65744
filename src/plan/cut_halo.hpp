#pragma once
// Internal to src/plan: which constraints each part of a cut plan solves, and where the parts exchange.

#include "taut/plan/cut.hpp"
#include "taut/plan/cut_passes.hpp"

#include <map>
#include <set>

namespace taut {

/// Constraints of each colour that a part solves, in their order.
using Selection = std::map<ColourKey, std::vector<std::uint32_t>>;

/// Where the parts exchange.
struct ExchangePoints
{
    std::vector<std::size_t> before;                  ///< passes of the whole
    std::vector<std::vector<std::uint32_t>> buffers;  ///< of each point
    std::vector<std::vector<const Dispatch*>> sweeps; ///< passes over constraints after each point
};

ExchangePoints exchange_points(const Plan& whole, Exchange exchange);

/// What a part solves, and the vertices that it reads for that: `reach` holds its own on entry, and is then
/// those and the halo.
Selection select_constraints(const Plan& whole, const ExchangePoints& points, std::vector<bool>& reach);

/// The corners of a constraint, in the whole plan.
std::vector<std::uint32_t> corners_of(const Plan& whole, const Dispatch& pass, std::uint32_t constraint);

} // namespace taut
