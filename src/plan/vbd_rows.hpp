#pragma once
// Internal to src/plan: the rows of vertex block descent and the lists of elements they read.

#include "taut/plan/springs.hpp"
#include "taut/plan/vbd.hpp"

namespace taut {

/// Springs, hinges and tetrahedra of all bodies with those at each vertex.
struct BlockElements
{
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<VolumeElement> volumes;
    std::vector<SolidElement> solids;
    Incidence at_spring, at_hinge, at_volume, at_solid;

    bool empty() const { return springs.empty() && hinges.empty() && volumes.empty() && solids.empty(); }
    std::uint32_t at(std::uint32_t v) const
    {
        std::uint32_t count = 0;
        for (const Incidence* all : {&at_spring, &at_hinge, &at_volume, &at_solid})
            count += all->start[v + 1] - all->start[v];
        return count;
    }
};

BlockElements elements_of(PlanBuilder& builder);

/// Adds the buffers of rows, spring ends and corners of hinges and tetrahedra, in the order of the sweep, and
/// the averages. `colours`: plan vertices that move. `blocks` knows how many rows, and of what.
void add_rows(PlanBuilder& builder, BlockBuffers& blocks, const BlockElements& elements,
              const std::vector<std::vector<std::uint32_t>>& colours);

} // namespace taut
