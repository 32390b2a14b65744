#include "taut/linear/partition.hpp"

#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

using namespace taut::linear;

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// 3 x 3 blocks on the diagonal and at both places of each edge.
SparseMatrix graph(std::uint32_t vertices, const std::vector<Edge>& edges)
{
    std::vector<Triplet> entries;
    const auto block = [&](std::uint32_t v, std::uint32_t w) {
        for (std::uint32_t i = 0; i < 3; ++i)
            for (std::uint32_t j = 0; j < 3; ++j)
                entries.push_back({3 * v + i, 3 * w + j, 1});
    };
    for (std::uint32_t v = 0; v < vertices; ++v)
        block(v, v);
    for (const auto& [v, w] : edges)
        block(v, w), block(w, v);
    return from_triplets(3 * vertices, 3 * vertices, entries);
}

std::vector<Edge> grid(std::uint32_t side)
{
    std::vector<Edge> edges;
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i)
        {
            if (i + 1 < side)
                edges.push_back({j * side + i, j * side + i + 1});
            if (j + 1 < side)
                edges.push_back({j * side + i, (j + 1) * side + i});
        }
    return edges;
}

std::map<std::uint32_t, std::uint32_t> sizes_of(const std::vector<std::uint32_t>& part)
{
    std::map<std::uint32_t, std::uint32_t> sizes;
    for (const std::uint32_t p : part)
        ++sizes[p];
    return sizes;
}

} // namespace

TEST_CASE("parts are numbered from 0, of like size, and short where they meet")
{
    const std::uint32_t side = 40;
    const std::vector<Edge> edges = grid(side);
    const SparseMatrix pattern = graph(side * side, edges);
    for (const std::uint32_t parts : {1u, 2u, 7u, 32u, 64u})
    {
        CAPTURE(parts);
        const auto part = partition(pattern, parts, std::vector<bool>(side * side, false));
        const auto sizes = sizes_of(part);
        REQUIRE(sizes.size() == parts);
        CHECK(sizes.begin()->first == 0);
        CHECK(sizes.rbegin()->first == parts - 1);
        const double mean = double(side) * side / parts;
        for (const auto& [number, size] : sizes)
            CHECK(std::abs(size - mean) <= 7); // one vertex a level of halving
        const auto cut = std::count_if(edges.begin(), edges.end(), [&](const Edge& edge) {
            return part[edge.first] != part[edge.second];
        });
        // Squares would cut 2 side (sqrt(parts) - 1) edges, diagonals twice as many; parts by number nearly
        // all.
        CHECK(double(cut) <= 4.0 * side * (std::sqrt(parts) - 1) + side);
    }
}

TEST_CASE(
    "vertices that are left out have no part, and pieces that do not hang together share one only at a cut")
{
    std::vector<Edge> edges = grid(12);
    const auto one = static_cast<std::uint32_t>(edges.size());
    for (std::uint32_t k = 0; k < one; ++k)
        edges.push_back({edges[k].first + 144, edges[k].second + 144});
    std::vector<bool> left_out(290, false); // the last two stand alone
    for (std::uint32_t v = 0; v < 12; ++v)
        left_out[v] = true;
    const auto part = partition(graph(290, edges), 4, left_out);
    for (std::uint32_t v = 0; v < 290; ++v)
        CHECK((part[v] == kNoPart) == left_out[v]);
    std::set<std::uint32_t> first(part.begin() + 12, part.begin() + 144),
        second(part.begin() + 144, part.begin() + 288), both;
    std::set_intersection(first.begin(), first.end(), second.begin(), second.end(),
                          std::inserter(both, both.end()));
    CHECK(both.size() <= 1);
}

TEST_CASE("there are never more parts than vertices, and none without any")
{
    CHECK(sizes_of(partition(graph(3, {{0, 1}}), 9, std::vector<bool>(3, false))).size() == 3);
    CHECK(partition(graph(2, {}), 4, {true, true}) == std::vector<std::uint32_t>{kNoPart, kNoPart});
    CHECK(partition(graph(2, {}), 0, {false, false}) == std::vector<std::uint32_t>{0, 0});
}
