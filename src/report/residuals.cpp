#include "taut/report/residuals.hpp"

#include "taut/plan/methods.hpp"

namespace taut {

Residuals residuals_ahead(const World& world)
{
    const MethodKind kind = method_of(world.scene());
    if (kind != MethodKind::xpbd && kind != MethodKind::implicit_euler && kind != MethodKind::vbd)
        return {};
    WorldOptions options;
    options.plan.residuals = true;
    World copy(world.scene(), world.device().shared_from_this(), options);
    copy.restore(world.state());
    copy.step();
    const StepReport further = measure(copy);
    return {further.primal_residual, further.dual_residual, further.imbalance, further.stretch_residual,
            further.load_residual};
}

void judge_residuals(const Scene& scene, const Residuals& left, StepReport& report)
{
    report.primal_residual = left.primal;
    report.dual_residual = left.dual;
    report.imbalance = left.imbalance;
    report.stretch_residual = left.stretch;
    report.load_residual = left.load;
    judge_residuals(scene, report);
}

} // namespace taut
