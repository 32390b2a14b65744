#pragma once
// What `taut solve` found out, and how it prints that.

#include "taut/cli/output.hpp"
#include "taut/linear/solve.hpp"

#include <optional>
#include <string>

namespace taut::cli {

struct SolveResult
{
    std::string matrix;          ///< file as given
    std::string right_hand_side; ///< file as given; empty: manufactured
    double tolerance = 0;        ///< asked for
    linear::SolveReport report;
    std::optional<double> forward_error; ///< where the exact solution is known
    std::vector<std::string> written;    ///< files
};

/// The keys are documented in docs/program.md.
Json to_json(const SolveResult& result);

/// For people: a few lines, the error beside the time.
std::string summary(const SolveResult& result);

/// "iteration,relative_residual" and a line an iteration.
std::string history_csv(const linear::SolveReport& report);

} // namespace taut::cli
