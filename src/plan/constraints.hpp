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

/// How constraints of one kind are laid out.
struct SetOptions
{
    std::string_view kind; ///< of the ConstraintSet, and the effect that pays for its buffers
    bool multipliers = false;
    std::uint32_t hub_degree = 0; ///< springs: as ColouringOptions::hub_degree
    bool keeps = false;           ///< multipliers of one iteration, too: something reads them afterwards
};

/// Colours the springs (or hinges) of all bodies, adds their records as buffers and the set to the plan;
/// nothing where there are none.
void prepare_springs(PlanBuilder& builder, const SetOptions& options);
void prepare_hinges(PlanBuilder& builder, const SetOptions& options);
/// The plan's constraints of a kind; null without any.
const ConstraintSet* find_set(const Plan& plan, std::string_view kind);

/// Colours of the edges of a generated grid and of the springs of its network, by direction and parity: 8
/// for edges, 12 with springs to the second neighbours. What colour_greedy finds only with luck. `edges` are
/// pairs of the grid's own vertices, a < b, one apart along rows, columns and diagonals, or two along rows or
/// columns.
Colouring grid_edge_colouring(std::span<const std::array<std::uint32_t, 2>> edges, std::uint32_t columns);

} // namespace taut
