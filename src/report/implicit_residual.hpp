#pragma once
// What the last substep of implicit_euler, vbd or xpbd left unsolved.

#include "taut/report/load_residual.hpp"
#include "taut/report/report.hpp"
#include "taut/report/world_view.hpp"

namespace taut {

/// Whether the plan has the effect of that name.
bool has_effect(const reference::View& view, std::string_view name);

/// Fills in primal_residual and imbalance (report.hpp). Leaves them where the plan keeps no inertial guess,
/// and where elements flow, whose rest shapes the model does not know.
void measure_implicit_residual(const reference::View& view, StepReport& out);

/// StepReport::load_residual of a world that has just made a step; -1 where there is none. Solves a linear
/// system of the whole scene: for the end of a run, not for every look.
LoadResidual measure_load_residual(const World& world);

} // namespace taut
