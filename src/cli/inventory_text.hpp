#pragma once
// Buffers and kernels of a plan as `taut plan` shows them: as JSON, and as the Markdown tables of a page.

#include "taut/cli/output.hpp"
#include "taut/plan/plan.hpp"

#include <string>

namespace taut::cli {

/// [{name, effect, bytes, written_by_host, read_by, written_by}]
Json buffers_json(const Plan& plan);

/// [{name, effect, dispatches_per_step, elements_per_step or groups_per_step}]
Json kernels_json(const Plan& plan);

/// Two tables with a blank line between them, buffers and kernels.
std::string inventory_markdown(const Plan& plan);

} // namespace taut::cli
