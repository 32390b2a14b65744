#pragma once
// The surface that a distance field says, as triangles for pictures.

#include "taut/scene/distance_field.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace taut {

struct FieldSurface
{
    std::vector<glm::dvec3> positions;                   ///< m, in the frame of the field's file
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise as seen from outside
};

/// Where the field is 0: closed, one vertex for each edge of six tetrahedra a cell that the surface goes
/// through.
FieldSurface surface_of(const DistanceField& field);

} // namespace taut
