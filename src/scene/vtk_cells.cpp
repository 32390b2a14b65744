#include "taut/scene/vtk_cells.hpp"

namespace taut::scene_file {
namespace {

constexpr std::int64_t kVtkTetrahedron = 10, kVtkTetrahedron10 = 24;

/// Of a cell whose end is sound.
std::string add_cell(const VtkCells& cells, std::size_t cell, std::size_t begin, std::size_t end,
                     SolidBuilder& solid)
{
    const std::int64_t type = cells.types[cell];
    const std::string name = "cell " + std::to_string(cell);
    if (type == kVtkTetrahedron10)
        return name + " is a tetrahedron of ten points (type 24); they must have 4";
    if (type != kVtkTetrahedron)
        return {};
    if (end - begin != 4)
        return name + " is a tetrahedron (type 10) of " + std::to_string(end - begin) +
               " points; it must have 4";
    const auto* c = cells.connectivity.data() + begin;
    return solid.add_tetrahedron(static_cast<std::int64_t>(cell), {c[0], c[1], c[2], c[3]});
}

} // namespace

std::string add_vtk_cells(const std::vector<glm::dvec3>& points, const VtkCells& cells, SolidBuilder& solid)
{
    if (cells.types.size() != cells.ends.size())
        return "there are " + std::to_string(cells.ends.size()) + " cells and " +
               std::to_string(cells.types.size()) + " types of cells; there must be as many";
    for (std::size_t v = 0; v < points.size(); ++v)
        solid.add_vertex(static_cast<std::int64_t>(v), points[v]);
    solid.close_vertices(); // numbered here: none twice
    std::size_t begin = 0;
    for (std::size_t c = 0; c < cells.ends.size(); ++c)
    {
        const auto end = static_cast<std::uint64_t>(cells.ends[c]);
        if (cells.ends[c] < 0 || end < begin || end > cells.connectivity.size())
            return "cell " + std::to_string(c) + " ends at " + std::to_string(cells.ends[c]) +
                   "; it must be from " + std::to_string(begin) + " to " +
                   std::to_string(cells.connectivity.size());
        if (const std::string wrong = add_cell(cells, c, begin, end, solid); !wrong.empty())
            return wrong;
        begin = end;
    }
    return {};
}

} // namespace taut::scene_file
