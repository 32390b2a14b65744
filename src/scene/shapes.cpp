// Generated shapes: grids of cloth and chains.

#include "taut/scene/mesh.hpp"

#include <cassert>

namespace taut {

namespace {

/// Position i of n evenly spaced ones from -extent/2 to +extent/2; symmetric to the last bit.
double centred(std::uint32_t i, std::uint32_t n, double extent)
{
    const double twice = 2.0 * i - n;
    return 0.5 * extent * (twice / n);
}

} // namespace

Mesh make_grid(std::uint32_t columns, std::uint32_t rows, double width, double height, bool alternating)
{
    assert(columns > 0 && rows > 0);
    Mesh mesh;
    mesh.grid_columns = columns + 1;
    mesh.grid_rows = rows + 1;
    mesh.positions.reserve(std::size_t(mesh.grid_columns) * mesh.grid_rows);
    for (std::uint32_t row = 0; row <= rows; ++row)
        for (std::uint32_t column = 0; column <= columns; ++column)
            mesh.positions.emplace_back(centred(column, columns, width), -centred(row, rows, height), 0.0);

    mesh.triangles.reserve(2 * std::size_t(columns) * rows);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column)
        {
            // All triangles are counter-clockwise seen from +z.
            const std::uint32_t top_left = row * mesh.grid_columns + column, top_right = top_left + 1;
            const std::uint32_t bottom_left = top_left + mesh.grid_columns, bottom_right = bottom_left + 1;
            if (alternating && (row + column) % 2 == 1)
            {
                mesh.triangles.push_back({top_left, bottom_left, top_right});
                mesh.triangles.push_back({top_right, bottom_left, bottom_right});
            }
            else
            {
                mesh.triangles.push_back({top_left, bottom_left, bottom_right});
                mesh.triangles.push_back({top_left, bottom_right, top_right});
            }
        }
    return mesh;
}

Mesh make_chain(std::uint32_t links, double length, double width)
{
    Mesh mesh;
    mesh.link_width = width;
    mesh.positions.reserve(std::size_t(links) + 1);
    mesh.positions.emplace_back(0.0);
    mesh.links.reserve(links);
    for (std::uint32_t link = 0; link < links; ++link)
    {
        mesh.positions.emplace_back(0.0, -length * (double(link + 1) / links), 0.0);
        mesh.links.push_back({link, link + 1});
    }
    return mesh;
}

} // namespace taut
