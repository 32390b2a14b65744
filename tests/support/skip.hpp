#pragma once
// What a test leaves out because a device or data is not here is seen: on standard error, in a list at the
// end of the program, and by its exit status kSkipped, which ctest shows as "Skipped" (SKIP_RETURN_CODE).

#include "support/catch.hpp"

#include <set>
#include <sstream>
#include <string>

namespace taut {

/// Exit status of a test program whose tests passed, but for what was left out.
inline constexpr int kSkipped = 77;

/// What was left out in this program so far.
const std::set<std::string>& left_out_so_far();

/// Call where a test goes without something. Counts as an assertion: test cases without any fail.
void left_out(const std::string& what);

} // namespace taut

#define TAUT_LEFT_OUT(stream)                                                                                \
    do                                                                                                       \
    {                                                                                                        \
        std::ostringstream taut_text;                                                                        \
        taut_text << stream;                                                                                 \
        taut::left_out(taut_text.str());                                                                     \
    } while (false)
