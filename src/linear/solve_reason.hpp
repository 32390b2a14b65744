#pragma once
// The sentence that goes with a status.

#include "taut/linear/cg.hpp"
#include "taut/linear/solve.hpp"

#include <string>

namespace taut::linear {

/// One sentence with the numbers that led to report.status. `beyond_double`: an iterate was left out because
/// a double does not hold it.
std::string reason_of(const SolveReport&, const CgOutcome&, const SolveOptions&, bool beyond_double);

} // namespace taut::linear
