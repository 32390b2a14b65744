#pragma once
// Internal to src/world: what friction between surfaces holds, apart from the lists of a plan.

#include "taut/world/world.hpp"

#include <span>

namespace taut {

/// Pairs under new numbers: `from` has of each new vertex the old one. Those with a vertex that has become
/// none, or several, are left out.
std::vector<HeldPair> renumbered(std::span<const HeldPair> pairs, std::span<const std::uint32_t> from);

/// Throws Error{bad_input} where a pair has a vertex beyond `vertices`, or a number that is not finite.
void check_held(std::span<const HeldPair> pairs, std::uint32_t vertices);

} // namespace taut
