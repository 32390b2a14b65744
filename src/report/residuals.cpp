#include "taut/report/residuals.hpp"

#include "taut/plan/methods.hpp"
#include "taut/runtime/base/shown.hpp"

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
    // Just 1, but for roundings, is what a solver leaves that does nothing. Judged at the end of a run
    // only: a stiff body that was just let go may leave more for some steps.
    const std::string bound = shown(100 * scene.accept.residual, 3);
    if ((1 + 1e-6) * left.load > scene.accept.residual)
        set_status({Status::unconverged, "the solver left " + shown(100 * left.load, 3) +
                                             " % of a body's loads (weight and inertia), accept.residual " +
                                             "is " + bound + " %; take more substeps or iterations"},
                   report);
}

} // namespace taut
