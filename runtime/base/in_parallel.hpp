#pragma once
// Work of the host that is cut into parts, on all cores.

#include <cstdint>
#include <functional>

namespace taut {

/// Calls part(k) once for each k of 0..count-1, on as many threads as the machine has and the system gives,
/// the calling one among them; at once, and in any order, begun in order of k. Returns when all are done.
/// Throws what a part threw first; then parts that nobody has begun are left out. May be called from several
/// threads, and from within a part: each call starts threads of its own.
void in_parallel(std::uint32_t count, const std::function<void(std::uint32_t)>& part);

} // namespace taut
