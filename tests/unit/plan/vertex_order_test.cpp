// The order that vertices get in a plan.

#include "meshes.hpp"
#include "support/catch.hpp"
#include "taut/plan/topology.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <set>

using namespace taut;
using namespace taut::meshes;

TEST_CASE("the vertex order of a square follows the Z of the Morton curve", "[topology]")
{
    std::vector<glm::dvec3> positions;
    for (int y = 0; y < 4; ++y)
    {
        for (int x = 0; x < 4; ++x)
        {
            positions.emplace_back(x, y, 7);
        }
    }
    const std::vector<std::uint32_t> expected = {0, 1, 4, 5, 2, 3, 6, 7, 8, 9, 12, 13, 10, 11, 14, 15};
    CHECK(locality_order(positions) == expected);
}

TEST_CASE("points on a line come out in order, whichever axis it follows", "[topology]")
{
    std::vector<std::uint32_t> ranks(1000);
    std::iota(ranks.begin(), ranks.end(), 0u);
    std::shuffle(ranks.begin(), ranks.end(), std::mt19937(4));
    for (int axis = 0; axis < 3; ++axis)
    {
        std::vector<glm::dvec3> positions(ranks.size(), glm::dvec3(-5));
        for (std::size_t i = 0; i < ranks.size(); ++i)
        {
            positions[i][axis] = 0.001 * ranks[i];
        }
        const auto order = locality_order(positions);
        CHECK(std::is_sorted(order.begin(), order.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return ranks[a] < ranks[b]; }));
    }
}

TEST_CASE("the vertex order keeps equal points in order and is a permutation of any input", "[topology]")
{
    const std::vector<glm::dvec3> equal(50, glm::dvec3(3, -2, 1));
    std::vector<std::uint32_t> identity(50);
    std::iota(identity.begin(), identity.end(), 0u);
    CHECK(locality_order(equal) == identity);
    CHECK(locality_order({}).empty());

    using Limits = std::numeric_limits<double>;
    const double nan = Limits::quiet_NaN(), inf = Limits::infinity(), huge = Limits::max();
    const double tiny = Limits::denorm_min();
    const std::vector<double> values = {0, -0.0, 1, -1e300, huge, -huge, tiny, nan, inf, -inf};
    std::vector<glm::dvec3> hostile;
    std::mt19937 random(5);
    for (int i = 0; i < 200; ++i)
    {
        hostile.emplace_back(values[random() % 10], values[random() % 10], values[random() % 10]);
    }
    auto order = locality_order(hostile);
    std::sort(order.begin(), order.end());
    identity.resize(200);
    std::iota(identity.begin(), identity.end(), 0u);
    CHECK(order == identity);
}

TEST_CASE("the vertex order does not depend on position or unit, nor on noise across a sheet", "[topology]")
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<glm::dvec3> sheet, moved, noisy;
    for (int i = 0; i < 2000; ++i)
    {
        // Multiples of 1/4096, so that scaling by a power of two and the shift are exact.
        const glm::dvec3 p(std::floor(unit(random) * 4096) / 4096, std::floor(unit(random) * 4096) / 4096, 0);
        sheet.push_back(p);
        moved.push_back(1024.0 * p + glm::dvec3(64, -32, 8));
        noisy.push_back(p + glm::dvec3(0, 0, 1e-9 * unit(random)));
    }
    CHECK(locality_order(moved) == locality_order(sheet));
    CHECK(locality_order(noisy) == locality_order(sheet));
}

TEST_CASE("the vertex order shortens the jumps along the edges of a shuffled sheet", "[topology]")
{
    const std::uint32_t n = 64;
    const Mesh mesh = cut_grid(n, n);
    std::vector<std::uint32_t> shuffled(n * n), place(n * n);
    std::iota(shuffled.begin(), shuffled.end(), 0u);
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(2));
    std::vector<glm::dvec3> positions(n * n);
    for (std::uint32_t i = 0; i < n * n; ++i)
    {
        positions[shuffled[i]] = mesh.positions[i];
    }
    const auto order = locality_order(positions);
    for (std::uint32_t i = 0; i < n * n; ++i)
    {
        place[order[i]] = i;
    }
    std::size_t near = 0, near_before = 0, total = 0;
    for (const MeshEdge& e : mesh_edges(mesh))
    {
        const auto jump = [](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
        near += jump(place[shuffled[e.a]], place[shuffled[e.b]]) <= 16;
        near_before += jump(shuffled[e.a], shuffled[e.b]) <= 16;
        ++total;
    }
    CHECK(near * 3 > total * 2);
    CHECK(near_before * 10 < total);
}
