// Colourings of the springs of grids.

#include "graphs.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <random>
#include <set>

using namespace taut;
using namespace taut::graphs;

TEST_CASE("springs of a grid number what the formula says, in 4, 8 and 12 valid even colours", "[colouring]")
{
    for (const std::uint32_t n : {32u, 64u, 128u, 256u})
    {
        const std::uint32_t structural = 2 * n * (n - 1);
        const std::uint32_t with_shear = structural + 2 * (n - 1) * (n - 1);
        const std::vector<std::uint32_t> counts = {structural, with_shear, with_shear + 2 * n * (n - 2)};
        for (std::uint32_t level = 0; level < 3; ++level)
        {
            const auto springs = grid_springs(n, n, level > 0, level > 1);
            const Colouring c = colouring_of(springs);
            CHECK(springs.size() == counts[level]);
            CHECK(c.colour_count() == 4 * (level + 1));
            CHECK(largest(sizes(c)) - smallest(sizes(c)) <= 2 * n); // an odd number of rows is left
            CHECK(std::is_sorted(c.order.begin(), c.order.end()));
            require_valid(c, graph_of(n * n, springs));
        }
    }
    CHECK(grid_springs(256, 256, true, true).size() == 390658);
}

TEST_CASE("springs of a grid join the neighbours they should, each pair once", "[colouring]")
{
    const std::uint32_t columns = 7, rows = 5;
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen, expected;
    for (const GridSpring& s : grid_springs(columns, rows, true, true))
    {
        seen.insert(std::minmax(s.a, s.b));
    }
    for (int a = 0; a < 35; ++a)
    {
        for (int b = a + 1; b < 35; ++b)
        {
            const int dx = std::abs(a % 7 - b % 7), dy = b / 7 - a / 7;
            if (dx + dy == 1 || (dx == 1 && dy == 1) || (dx == 2 && dy == 0) || (dx == 0 && dy == 2))
            {
                expected.emplace(a, b);
            }
        }
    }
    CHECK(seen == expected);
    CHECK(grid_springs(columns, rows, true, true).size() == expected.size());
}

TEST_CASE("narrow grids and grids without diagonals keep valid colours, none empty", "[colouring]")
{
    for (std::uint32_t columns = 0; columns < 6; ++columns)
    {
        for (std::uint32_t rows = 0; rows < 6; ++rows)
        {
            for (const bool diagonals : {false, true})
            {
                for (const bool skip : {false, true})
                {
                    const auto springs = grid_springs(columns, rows, diagonals, skip);
                    const Colouring c = colouring_of(springs);
                    require_valid(c, graph_of(columns * rows, springs));
                    CHECK((c.colour_count() == 0 || smallest(sizes(c)) > 0));
                }
            }
        }
    }
    CHECK(colouring_of(grid_springs(9, 9, false, true)).colour_count() == 8);
    CHECK(colouring_of(grid_springs(1, 9, true, false)).colour_count() == 2);
}

TEST_CASE("greedy colours of a 64 x 64 grid are at most the published 4, 8 and 13", "[colouring]")
{
    const std::vector<std::size_t> published = {4, 8, 13};
    for (std::uint32_t level = 0; level < 3; ++level)
    {
        const auto springs = grid_springs(64, 64, level > 0, level > 1);
        const ConstraintGraph graph = graph_of(64 * 64, springs);
        for (const bool balance : {false, true})
        {
            const Colouring c = colour_greedy(graph, {64, balance});
            require_valid(c, graph);
            CHECK(c.colour_count() <= published[level]);
            CHECK(c.colour_count() >= 4 * (level + 1));
        }
    }
}

TEST_CASE("springs in random order cost one colour more than the degree at most", "[colouring]")
{
    auto springs = grid_springs(64, 64, true, true);
    std::shuffle(springs.begin(), springs.end(), std::mt19937(1));
    const ConstraintGraph graph = graph_of(64 * 64, springs);
    const Colouring plain = colour_greedy(graph, {64, false}), even = colour_greedy(graph);
    require_valid(plain, graph);
    require_valid(even, graph);
    CHECK(plain.colour_count() <= 13); // plain first fit takes 16
    CHECK(even.colour_count() <= plain.colour_count());
    CHECK(smallest(sizes(even)) > smallest(sizes(plain)));
    const std::size_t mean = springs.size() / even.colour_count();
    CHECK(smallest(sizes(plain)) * 100 < mean * 90);
    CHECK(smallest(sizes(even)) * 100 > mean * 95);
    CHECK(largest(sizes(even)) * 100 < mean * 105);
}
