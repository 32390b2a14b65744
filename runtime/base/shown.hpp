#pragma once
// Numbers in messages.

#include <cstdint>
#include <string>
#include <string_view>

namespace taut {

/// The shortest decimal text that reads back as the same number ("1e-09", "0.1", "inf", "nan"). Never
/// follows the locale, as std::to_string and printf do.
std::string shown(double value);

/// At most `digits` significant digits, as printf("%.*g") in the "C" locale. For tables and sentences in
/// which more digits would say nothing. 1 <= digits <= 17.
std::string shown(double value, int digits);

/// A share as "12.3 %", at most `digits` significant digits.
std::string shown_percent(double share, int digits = 3);

/// "1 entry", "0 entries": the count and what is counted, in its right form.
std::string counted(std::uint64_t count, std::string_view one, std::string_view several);

} // namespace taut
