#pragma once
// The cells of VTK's grids, which its text files and its XML files share.

#include "taut/scene/solid_builder.hpp"

#include <string>
#include <vector>

namespace taut::scene_file {

struct VtkCells
{
    std::vector<std::int64_t> connectivity; ///< points of all cells, numbered from 0
    std::vector<std::int64_t> ends;         ///< of each cell in `connectivity`
    std::vector<std::int64_t> types;        ///< of each cell
};

/// The points and the tetrahedra among the cells; returns what is wrong with them, or nothing.
std::string add_vtk_cells(const std::vector<glm::dvec3>& points, const VtkCells& cells, SolidBuilder& solid);

} // namespace taut::scene_file
