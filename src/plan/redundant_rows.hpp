#pragma once
// Internal to src/plan: which springs of a body, were they rigid, would be more equations than its vertices
// have freedom.

#include "taut/plan/material.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace taut {

struct RedundantRows
{
    std::vector<bool> redundant;     ///< a spring
    std::vector<bool> contradictory; ///< of these, it joins the same vertices as another of another length
};

/// By counting, not by places: vertices with at most three springs are taken away with them until none is
/// left (each adds three freedoms and at most three equations); of what remains, connected parts with more
/// springs than 3 n - 6 are redundant (n vertices that move; - 3, - 1, - 0 with one, two, more held vertices
/// on the part). The same spring twice counts once, unless its lengths differ: such are redundant wherever
/// they are. Based on: Maxwell's count of bars (1864), by parts.
/// Springs index `inverse_mass` [1/kg, 0 = held] and have an end that moves.
RedundantRows redundant_rows(std::span<const StretchElement> springs, std::span<const double> inverse_mass);

} // namespace taut
