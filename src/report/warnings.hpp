#pragma once
// Events of a world as warnings of a report.

#include "taut/report/report.hpp"

namespace taut {

/// Adds a count that is not 0.
void count(Warning warning, std::uint64_t times, std::map<std::string, std::uint64_t>& warnings);

/// Adds the counts that are not 0 under the words of Warning.
void add_warnings(const Events& events, std::map<std::string, std::uint64_t>& warnings);

} // namespace taut
