#pragma once
// What the last substep of a world left unsolved.

#include "taut/report/report.hpp"
#include "taut/report/world_view.hpp"

namespace taut {

/// Fills in primal_residual, dual_residual, stretch_residual and imbalance (report.hpp); of a plan without
/// their buffers (PlanOptions::residuals) they stay -1.
void measure_residuals(const reference::View& view, StepReport& out);

} // namespace taut
