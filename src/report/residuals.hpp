#pragma once
// What the last substep of a step left unsolved, asked of a world that does not keep what it takes to know.

#include "taut/report/report.hpp"

namespace taut {

/// As StepReport::primal_residual, dual_residual, imbalance, stretch_residual, flow_residual, load_residual
/// and load_way; -1 where there is none.
struct Residuals
{
    double primal = -1, dual = -1, imbalance = -1, stretch = -1, flow = -1, load = -1, load_way = 0;
};

/// Residuals of xpbd need multipliers, which a run does not keep. So they are those of a copy that keeps them
/// and goes one step further; the world itself stays as it is. The load residual of implicit_euler and vbd is
/// the least of up to five steps further, until one is accepted: what a step leaves and the next takes back
/// is noise of the solve. -1 under methods without any, without making a
/// copy. Throws Error{bad_input} for a world that holds a value that is not finite.
Residuals residuals_ahead(const World& world);

/// Puts residuals into a report and judges them by what the scene accepts, load_residual with them: what
/// `taut run` does with the state in which a run ends, after measure().
void judge_residuals(const Scene& scene, const Residuals& left, StepReport& report);

} // namespace taut
