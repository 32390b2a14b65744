#include "taut/report/residuals.hpp"

#include "taut/plan/methods.hpp"
#include "taut/report/implicit_residual.hpp"
#include "taut/report/load_residual.hpp"
#include "taut/report/warnings.hpp"
#include "taut/runtime/base/shown.hpp"

namespace taut {
namespace {

/// Steps ahead in each of which a body has to be beyond that: what one step leaves and the next one takes
/// back is noise of the solve, not a motion that is missing.
constexpr int kLooksAhead = 5;

/// The least that any of the steps from this one on leaves; stops at the first that is accepted.
LoadResidual lasting_load_residual(World& world)
{
    LoadResidual least = measure_load_residual(world);
    const double accepted = kLoadShare * world.scene().accept.residual;
    for (int look = 1; look < kLooksAhead && least.share > accepted; ++look)
    {
        world.step();
        const LoadResidual next = measure_load_residual(world);
        least = next.share < least.share ? next : least;
    }
    return least;
}

} // namespace

Residuals residuals_ahead(const World& world)
{
    const MethodKind kind = world.scene().method.type;
    if (kind != MethodKind::xpbd && kind != MethodKind::implicit_euler && kind != MethodKind::vbd)
        return {};
    WorldOptions options;
    options.plan.residuals = true;
    World copy(world.scene(), world.device().shared_from_this(), options);
    copy.restore(world.state());
    copy.step();
    const StepReport further = measure(copy);
    const LoadResidual load =
        kind == MethodKind::xpbd ? measure_load_residual(copy) : lasting_load_residual(copy);
    return {further.primal_residual,
            further.dual_residual,
            further.imbalance,
            further.stretch_residual,
            further.flow_residual,
            load.share,
            load.way};
}

void judge_residuals(const Scene& scene, const Residuals& left, StepReport& report)
{
    report.primal_residual = left.primal;
    report.dual_residual = left.dual;
    report.imbalance = left.imbalance;
    report.stretch_residual = left.stretch;
    report.flow_residual = left.flow;
    report.load_residual = left.load;
    report.load_way = left.load_way;
    judge_residuals(scene, report);
    // Judged at the end of a run only: a stiff body that was just let go may leave more for some steps.
    const double accepted = kLoadShare * scene.accept.residual;
    const bool sweeps = scene.method.type == MethodKind::xpbd;
    if (left.load <= accepted && sweeps && left.load_way > kSeenWay)
        count(Warning::soft, 1, report.warnings); // little beside what its loads move, and yet to be seen
    if (left.load <= accepted)
        return;
    const std::string limit = "; a quarter of accept.residual (" + shown(scene.accept.residual, 3) +
                              ") is accepted; take more substeps or iterations" +
                              (sweeps || scene.method.precision == Precision::float64
                                   ? ""
                                   : ", or method.precision \"double\" where loads are next to nothing "
                                     "beside the stiffness");
    if (sweeps && left.load_way <= kSeenWay)
        count(Warning::soft, 1, report.warnings);
    else if (sweeps)
        set_status({Status::unconverged,
                    "a body is " + shown(100 * left.load_way, 3) +
                        " % of its size from where its material would hold its loads (weight, inertia), " +
                        shown(left.load, 3) + " times what they move it" + limit},
                   report);
    else
        set_status(
            {Status::unconverged, "one exact solve would move a body further by " + shown(left.load, 3) +
                                      " of what its loads (weight, inertia) move it in a substep" + limit},
            report);
}

} // namespace taut
