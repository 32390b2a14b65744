#pragma once
// Cells of CSV files (RFC 4180).

#include <string>

namespace taut {

/// The text as it is, in quotes if it holds a comma, a quote or a line end.
std::string csv_cell(const std::string& text);

} // namespace taut
