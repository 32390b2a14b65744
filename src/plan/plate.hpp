#pragma once
// Internal to src/plan: the effect plate (docs/effects/plate.md).

#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Buffers of the effect while a plan is made.
struct PlateBuffers
{
    std::uint32_t count = 0;                          ///< hinges of plates
    std::uint32_t hinges = kNoBuffer;                 ///< the method's own, of all bodies
    std::uint32_t multipliers = kNoBuffer;            ///< of these hinges, J s^2
    std::uint32_t record = kNoBuffer;                 ///< where in them each hinge of a plate is
    std::uint32_t neighbour = kNoBuffer;              ///< four a hinge
    std::uint32_t rule = kNoBuffer;                   ///< TAUT_PLATE_RULE a hinge
    std::uint32_t pull = kNoBuffer, turn = kNoBuffer; ///< two a hinge
};

/// Whether any body bends as a plate.
bool wants_plate(const Scene& resolved);

/// Refuses, as `unsupported`, bodies that would, under methods that have no such thing, where cloth can tear,
/// with an infinite rigidity, and with an edge of more than two triangles.
void check_plate(const Scene& resolved, Refusals& out);

/// After the effects that own the hinges: changes rest angles in place from then on. They and the turns
/// become part of a world's state (Plan::kept).
void prepare_plate(PlanBuilder& builder);
void record_plate(PlanBuilder& builder, const Moment& moment);

} // namespace taut
