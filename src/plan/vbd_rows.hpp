#pragma once
// Internal to src/plan: the rows of vertex block descent and the lists of elements they read.

#include "taut/plan/added_elements.hpp"
#include "taut/plan/springs.hpp"
#include "taut/plan/vbd.hpp"

namespace taut {

/// Springs, hinges, tetrahedra and added elements of all bodies with those at each vertex.
struct BlockElements
{
    std::vector<StretchElement> springs;
    std::vector<BendElement> hinges;
    std::vector<VolumeElement> volumes;
    std::vector<SolidElement> solids;
    std::vector<AddedSet> added;
    Incidence at_spring, at_hinge, at_volume, at_solid;
    std::vector<Incidence> at_added; ///< by kind

    bool empty() const
    {
        return springs.empty() && hinges.empty() && volumes.empty() && solids.empty() && added.empty();
    }
    std::uint32_t at(std::uint32_t v) const
    {
        std::uint32_t count = 0;
        for (const Incidence* all : {&at_spring, &at_hinge, &at_volume, &at_solid})
            count += all->start[v + 1] - all->start[v];
        for (const Incidence& all : at_added)
            count += all.start[v + 1] - all.start[v];
        return count;
    }
};

BlockElements elements_of(PlanBuilder& builder);

/// Adds the buffers of rows, spring ends and corners of hinges and tetrahedra, in the order of the sweep, and
/// the averages. `colours`: plan vertices that move. `blocks` knows how many rows, and of what.
void add_rows(PlanBuilder& builder, BlockBuffers& blocks, const BlockElements& elements,
              const std::vector<std::vector<std::uint32_t>>& colours);

/// Adds the buffers of added elements. After add_rows and prepare_vbd_start.
void prepare_vbd_added(PlanBuilder& builder, BlockBuffers& blocks, const BlockElements& elements,
                       const std::vector<std::vector<std::uint32_t>>& colours);
/// What they bring to the blocks of a colour, before its vertices take their step.
void record_vbd_added(PlanBuilder& builder, const BlockBuffers::Run& run, bool report);
/// Their part of the sums of vbd_rise, after it.
void record_vbd_added_rise(PlanBuilder& builder);

} // namespace taut
