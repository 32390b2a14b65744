#pragma once
// Internal to src/plan: the effect surface_volume (docs/effects/surface_volume.md).

#include "taut/plan/builder.hpp"

namespace taut {

/// Whether any body holds the volume within its surface.
bool any_surface_volume(const Scene& resolved);

/// Throws Error{limit} where more triangles meet at a vertex than one invocation may loop over.
void prepare_surface_volume(PlanBuilder& builder);
void record_surface_volume(PlanBuilder& builder, const Moment& moment);

/// Surfaces of bodies as the kernels of kernels/volume read them.
struct SurfaceTables
{
    std::vector<std::uint32_t> groups;   ///< 6 words each
    std::vector<std::uint32_t> vertices; ///< 2 words each, and the end
    std::vector<std::uint32_t> corners;  ///< 2 words each
    std::vector<std::size_t> bodies;     ///< of each surface
};

/// Those of the bodies that are `wanted` and have a vertex that moves. Throws Error{limit} as
/// prepare_surface_volume does, naming the `setting` that would do without.
SurfaceTables surface_tables(const PlanBuilder& builder, bool (*wanted)(const Body&),
                             std::string_view setting);
/// Adds the buffers of all but `values`; none where there are no surfaces.
void add_surface_tables(PlanBuilder& builder, std::string_view effect, const SurfaceTables& tables,
                        SurfaceBuffers& buffers);
/// The pass that gathers gradients and leaves the sums.
void record_surface_sums(PlanBuilder& builder, std::string_view effect, const SurfaceBuffers& buffers,
                         bool further);

/// Vertices of a group, a multiple of TAUT_LINEAR_GROUP: few enough to share the work, enough that no surface
/// has more than a thousand groups, since each of them adds up the sums of all.
std::uint32_t surface_chunk(std::uint32_t vertices);

} // namespace taut
