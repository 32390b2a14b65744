#pragma once
// The state of a solve between host and device (layout::CgState), for every solver that keeps one.

#include "taut/linear/cg.hpp"

namespace taut::linear {

/// What a solve starts from: everything zero but the settings and the rounding unit.
template <typename Real>
layout::CgState<Real> first_state(const CgSettings&);

/// Throws Error{bad_input} for settings with which no solve ends well.
void check_settings(const CgSettings&);

template <typename Real>
CgOutcome outcome_of(const layout::CgState<Real>&);

} // namespace taut::linear
