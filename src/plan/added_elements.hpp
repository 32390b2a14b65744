#pragma once
// Internal to src/plan: elements of kinds that the program has added (taut/elements/element.hpp), under xpbd.

#include "taut/plan/builder.hpp"

namespace taut {

/// Throws Error{bad_input} naming body, list and what would be right for an unknown kind or lists that do not
/// fit it, Error{unsupported} for a method without kernels for them and for bodies that tear.
void check_added_elements(const Scene& resolved);

/// Whether a body has any.
bool wants_added_elements(const Scene& resolved);

/// One set of coloured records a kind, in the order in which the scene names kinds first.
void prepare_added_elements(PlanBuilder& builder);
/// One sweep over all of them.
void record_added_elements(PlanBuilder& builder, const Moment& moment);

} // namespace taut
