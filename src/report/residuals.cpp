#include "taut/report/residuals.hpp"

#include "taut/plan/methods.hpp"
#include "taut/report/implicit_residual.hpp"
#include "taut/runtime/base/shown.hpp"

namespace taut {
namespace {

/// Of accept.residual: where nothing is done all of the loads' motion is left.
constexpr double kLoadShare = 0.25;

} // namespace

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
            measure_load_residual(copy)};
}

void judge_residuals(const Scene& scene, const Residuals& left, StepReport& report)
{
    report.primal_residual = left.primal;
    report.dual_residual = left.dual;
    report.imbalance = left.imbalance;
    report.stretch_residual = left.stretch;
    report.load_residual = left.load;
    judge_residuals(scene, report);
    // Judged at the end of a run only: a stiff body that was just let go may leave more for some steps.
    const double accepted = kLoadShare * scene.accept.residual;
    if (left.load > accepted)
        set_status({Status::unconverged,
                    "an exact substep would move a body further by " + shown(100 * left.load, 3) +
                        " % of what its loads (weight, inertia) move it; accept.residual lets " +
                        shown(100 * accepted, 3) + " % pass; take more substeps or iterations"},
                   report);
}

} // namespace taut
