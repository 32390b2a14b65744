// Based on: kernels/shared/cg_state.glsl, which decides; here its words are turned into statuses.
// Departures: none beyond those named there.

#include "taut/linear/cg_state.hpp"

#include <cmath>
#include <limits>

namespace taut::linear {
namespace {

Status status_of(std::uint32_t cause)
{
    switch (cause)
    {
    case TAUT_CG_CONVERGED: return Status::converged;
    case TAUT_CG_INDEFINITE_MATRIX: return Status::indefinite_matrix;
    case TAUT_CG_INDEFINITE_PRECONDITIONER: return Status::indefinite_preconditioner;
    case TAUT_CG_NON_FINITE: return Status::non_finite;
    case TAUT_CG_STALLED:
    case TAUT_CG_EXHAUSTED:
    case TAUT_CG_RAN_AWAY: return Status::stagnated;
    case TAUT_CG_ZERO_RIGHT_HAND_SIDE: return Status::zero_right_hand_side;
    default: return Status::iteration_limit;
    }
}

} // namespace

void check_settings(const CgSettings& settings)
{
    if (!(settings.tolerance > 0) || !(settings.replacement > 0 && settings.replacement < 1) ||
        !(settings.growth > 1))
        throw Error(ErrorCode::bad_input, "a tolerance above 0, a replacement in (0, 1) and a growth above 1 "
                                          "are wanted for conjugate gradients");
}

template <typename Real>
layout::CgState<Real> first_state(const CgSettings& settings)
{
    layout::CgState<Real> s{};
    s.tolerance_squared = static_cast<Real>(settings.tolerance * settings.tolerance);
    s.replacement_squared = static_cast<Real>(settings.replacement * settings.replacement);
    s.growth_squared = static_cast<Real>(settings.growth * settings.growth);
    s.epsilon = std::numeric_limits<Real>::epsilon() / 2;
    s.iteration_limit = settings.iteration_limit;
    s.patience = settings.patience;
    return s;
}
template layout::CgState<float> first_state<float>(const CgSettings&);
template layout::CgState<double> first_state<double>(const CgSettings&);

template <typename Real>
CgOutcome outcome_of(const layout::CgState<Real>& s)
{
    CgOutcome out;
    out.cause = s.status;
    out.running = s.status == TAUT_CG_RUNNING;
    out.status = status_of(s.status);
    out.iterations = s.iteration;
    out.replacements = s.replacements;
    out.residual = s.bb > 0 ? std::sqrt(static_cast<double>(s.rr) / static_cast<double>(s.bb)) : 0;
    out.curvature = static_cast<double>(s.curvature);
    out.curvature_ratio = s.steepest > 0 && s.pmp > 0 ? out.curvature / static_cast<double>(s.pmp) /
                                                            static_cast<double>(s.steepest)
                                                      : 0;
    out.rz = static_cast<double>(s.rz);
    return out;
}
template CgOutcome outcome_of<float>(const layout::CgState<float>&);
template CgOutcome outcome_of<double>(const layout::CgState<double>&);

} // namespace taut::linear
