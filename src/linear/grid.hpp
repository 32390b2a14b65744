#pragma once
// How the kernels of a solve share rows among work groups, and when they run.

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"
#undef TAUT_HOST

#include "taut/runtime/device.hpp"

namespace taut::linear {

/// Rows of a system: 2 * rows and 3 * rows, which kernels number with 32 bits, and the groups behind the last
/// row stay below 2^32.
inline constexpr std::uint64_t kMostRows = std::uint64_t{1} << 30;
/// Stored entries of a sparse format, padding included.
inline constexpr std::uint64_t kMostEntries = std::uint64_t{1} << 31;
/// Throws Error{limit} with both numbers for more than kMostRows (or columns).
void check_row_count(std::uint64_t rows);
/// Throws Error{limit} with both numbers, naming `what` ("format ell"), for more than kMostEntries.
void check_entry_count(std::uint64_t entries, std::string_view what);

/// `count` units (rows, block rows, entries) among `groups` work groups of TAUT_LINEAR_GROUP lanes: group g
/// takes units g*chunk up to (g+1)*chunk. Trailing groups may be empty.
struct Grid
{
    std::uint32_t count = 0;
    std::uint32_t groups = 1;
    std::uint32_t chunk = 0; ///< a multiple of `multiple`
};

/// Groups of every pass over a system of `rows` rows: one for each TAUT_LINEAR_GROUP rows, at most 256 (1,024
/// on a hardware GPU). Fixed by these two alone: sums then come in one order on all software executors.
std::uint32_t group_count_for(std::uint32_t rows, const DeviceInfo&);

/// Throws Error{limit} where groups * chunk would not fit 32 bits.
Grid make_grid(std::uint32_t count, std::uint32_t groups, std::uint32_t multiple = TAUT_LINEAR_GROUP);

/// When a pass runs: always, or with as many groups as a word of the solver's control buffer says (0: not at
/// all).
struct Gate
{
    std::uint32_t groups = 1;
    BufferPtr control;        ///< null: always
    std::uint64_t offset = 0; ///< bytes; three words
};

/// Adds one dispatch of a GROUP_KERNEL over gate.groups groups.
template <template <typename> typename Bindings>
void launch(Recorder& recorder, const Gate& gate, const Recorder::Form& form,
            const Bindings<Recorder::Binding>& bindings,
            const typename Bindings<Recorder::Binding>::Params& params)
{
    if (gate.control)
        recorder.dispatch_indirect(bindings, params, {gate.control, gate.offset, 12}, gate.groups, form);
    else
        recorder.dispatch(bindings, params, gate.groups, form);
}

} // namespace taut::linear
