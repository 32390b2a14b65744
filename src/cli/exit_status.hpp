#pragma once
// What the program's exit status says (docs/statuses.md, docs/program.md).

#include "taut/report/report.hpp"
#include "taut/runtime/base/error.hpp"

namespace taut::cli {

/// The list is closed; docs/program.md explains each.
enum Exit : int
{
    kDone = 0,
    kNotSound = 1, ///< it began, but the result is not sound or the machine gave up
    kBadInput = 2, ///< wrong arguments or input, or a file that cannot be read or written
    kNoDevice = 3,
};

/// Did it run, and is what came out sound?
bool sound(Status status);

/// After a run or a solve that ended so.
Exit exit_status(Status status);

/// After an Error of this code.
Exit exit_status(ErrorCode code);

} // namespace taut::cli
