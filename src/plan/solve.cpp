#include "taut/plan/solve.hpp"

#include "taut/kernels/solve_log.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

namespace taut {

PlanSolve::PlanSolve(PlanBuilder& builder, std::string_view effect,
                     std::shared_ptr<const linear::Operator> system, linear::Preconditioning preconditioning,
                     Inverses formed)
    : effect_(effect),
      operator_(std::move(system)),
      formed_(std::move(formed)),
      cg_(builder.paper(), operator_, preconditioning, false),
      groups_(linear::group_count_for(operator_->rows(), builder.paper()->info())),
      iterations_(builder.scene.method.linear_iterations)
{
    linear::CgSettings settings;
    settings.tolerance = builder.scene.method.linear_tolerance;
    settings.iteration_limit = iterations_;
    cg_.set(settings);
    b_ = builder.adopt(effect_, cg_.b());
    x_ = builder.adopt(effect_, cg_.x());
    if (preconditioning.inverse)
        inverse_ = builder.adopt(effect_, preconditioning.inverse);
    state_ = builder.adopt(effect_, cg_.state());
    with_real(builder.plan.precision, [&](auto zero) {
        log_ = builder.add_buffer(effect_, "solve log", sizeof(layout::SolveLog<decltype(zero)>));
    });
    builder.plan.solvers.push_back({effect_, state_, log_});
}

void PlanSolve::use_part(PlanBuilder& builder, std::uint32_t control, std::uint64_t groups,
                         std::uint64_t once)
{
    part_ = control;
    once_ = once;
    cg_.use_part(builder.on_paper(control), groups);
}

void PlanSolve::record(PlanBuilder& builder)
{
    builder.record(effect_, [this](Recorder& recorder) {
        for (const auto& inverse : formed_)
            inverse->record(recorder, {groups_, nullptr, 0});
        cg_.record_begin(recorder);
        cg_.record_iterations(recorder, iterations_);
        cg_.record_end(recorder);
    });
    const kernels::solve_log::Bindings<Use> uses = {.state = {state_}, .run_log = {log_}};
    if (part_ == kNoBuffer)
        builder.dispatch(effect_, "", uses, {1}, 1);
    else
        builder.dispatch_indirect(effect_, "", uses, {1}, 1, part_, once_);
}

} // namespace taut
