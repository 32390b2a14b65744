#pragma once
// Internal to src/plan: constraints of all bodies brought into colours, and their passes.

#include "taut/plan/builder.hpp"
#include "taut/plan/topology.hpp"

namespace taut {

/// Adds the buffers of the distance constraints (mesh edges, links, springs) and remembers their colours.
void prepare_distance(PlanBuilder& builder);
/// The same for hinges.
void prepare_bending(PlanBuilder& builder);

/// One sweep over all colours; runs of small colours become one pass (the tail rule).
void record_distance(PlanBuilder& builder, const Moment& moment);
void record_bending(PlanBuilder& builder, const Moment& moment);

/// Colours of the edges of a generated grid, by direction and parity: what colour_greedy finds only
/// with luck. `edges` are pairs of the grid's own vertices, a < b.
Colouring grid_edge_colouring(std::span<const std::array<std::uint32_t, 2>> edges, std::uint32_t columns);

} // namespace taut
