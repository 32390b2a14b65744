// Springs of a regular grid, coloured by direction and parity: no graph is needed.
// Based on:
//   W. Va, M.-H. Choi, M. Hong. Real-Time Cloth Simulation Using Compute Shader in Unity3D for AR/VR
//   Contents. Applied Sciences 11(17), 2021: structural, shear and bending springs of a grid.
// Departures: two springs of one direction share a vertex only if one starts where the other ends, so
// the parity of the start, in steps of the spring, separates them: two colours a direction.

#include "colouring_parts.hpp"

namespace taut {

namespace {

struct Direction
{
    std::uint32_t right = 0, down = 0; ///< in vertices
    bool leftwards = false;            ///< runs from the right end of the top row to the left end below
};

void add_springs(std::uint32_t columns, std::uint32_t rows, const Direction& d, std::uint8_t first_colour,
                 std::vector<GridSpring>& out)
{
    for (std::uint32_t parity = 0; parity < 2; ++parity)
    {
        for (std::uint32_t y = 0; y + d.down < rows; ++y)
        {
            for (std::uint32_t x = 0; x + d.right < columns; ++x)
            {
                // Diagonals go by the row: they also step one row down.
                const std::uint32_t step = d.down > 0 ? y / d.down : x / d.right;
                if (step % 2 == parity)
                {
                    const std::uint32_t top = y * columns + x, bottom = (y + d.down) * columns + x;
                    out.push_back({d.leftwards ? top + d.right : top, d.leftwards ? bottom : bottom + d.right,
                                   static_cast<std::uint8_t>(first_colour + parity)});
                }
            }
        }
    }
}

} // namespace

std::vector<GridSpring> grid_springs(std::uint32_t columns_of_vertices, std::uint32_t rows_of_vertices,
                                     bool diagonals, bool skip_one)
{
    assert(std::uint64_t(columns_of_vertices) * rows_of_vertices <= colouring::kNone);
    std::vector<Direction> directions = {{1, 0}, {0, 1}};
    if (diagonals)
    {
        directions.insert(directions.end(), {{1, 1}, {1, 1, true}});
    }
    if (skip_one)
    {
        directions.insert(directions.end(), {{2, 0}, {0, 2}});
    }
    std::vector<GridSpring> springs;
    springs.reserve(std::size_t(columns_of_vertices) * rows_of_vertices * directions.size());
    std::uint8_t colour = 0;
    for (const Direction& direction : directions)
    {
        add_springs(columns_of_vertices, rows_of_vertices, direction, colour, springs);
        colour = static_cast<std::uint8_t>(colour + 2);
    }
    return springs;
}

Colouring colouring_of(std::span<const GridSpring> springs)
{
    std::vector<std::vector<std::uint32_t>> classes(256);
    for (std::uint32_t i = 0; i < springs.size(); ++i)
    {
        classes[springs[i].colour].push_back(i);
    }
    Colouring out;
    out.colour_start = {0};
    out.hub_start = {0};
    out.order.reserve(springs.size());
    for (const auto& members : classes)
    {
        if (!members.empty())
        {
            out.order.insert(out.order.end(), members.begin(), members.end());
            out.colour_start.push_back(static_cast<std::uint32_t>(out.order.size()));
        }
    }
    return out;
}

} // namespace taut
