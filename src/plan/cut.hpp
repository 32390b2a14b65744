#pragma once
// A plan cut in two, for two devices. Each part moves its own vertices and repeats the constraints of the
// other that reach them before the next exchange, so both end with the bits that one device has.

#include "taut/plan/plan.hpp"

#include <array>

namespace taut {

/// How often the parts tell each other of the vertices beside the cut.
enum class Exchange
{
    sweep,  ///< before every sweep over the constraints: the fewest exchanges
    colour, ///< before every colour: the narrowest halo
};

/// One side of a cut.
struct PlanPart
{
    /// Passes and buffers, by the numbers of the whole; what names constraints, effects and pulls stays with
    /// the whole. Its vertices are `vertices`.
    Plan plan;
    std::vector<std::uint32_t> vertices; ///< of the whole plan: its own, then the halo: those of the other
    std::uint32_t own = 0;  ///< vertices that this part moves; 0: the other has all, and this no passes
    std::uint32_t sent = 0; ///< the last of them: the halo of the other, in its order
    /// First pass of each segment, and their number. The parts exchange between segments.
    std::vector<std::size_t> segment_start;
    /// Own vertices, and constraints solved in a sweep, those of four corners twice; and the same without
    /// what is solved for the halo, so that both parts' add up to the whole.
    std::uint64_t work = 0, own_work = 0;

    std::uint32_t halo() const { return static_cast<std::uint32_t>(vertices.size()) - own; }
};

struct PlanCut
{
    std::array<PlanPart, 2> parts;
    /// Buffers exchanged before each segment but the first: an element a vertex, the last `sent` own ones of
    /// each part into the halo of the other.
    std::vector<std::vector<std::uint32_t>> exchanged;
};

/// Cuts a plan before vertex `first_count` (0 to its vertex_count) of its order. The plan must have no
/// grouped colours. Throws Error{unsupported} naming an effect whose passes cannot be cut: those over single
/// vertices, moving pins and coloured constraints can.
PlanCut cut_plan(const Plan& whole, std::uint32_t first_count, Exchange exchange = Exchange::sweep);

} // namespace taut
