// Edges, hinges and a cache-friendly vertex order of a mesh.
// Based on:
//   G. M. Morton. A Computer Oriented Geodetic Data Base and a New Technique in File Sequencing.
//   IBM 1966: interleaved bits, at morton_code.
// Departures: cells are cubes over the longest side, so that a flat sheet with noise across it is
// ordered along the sheet.

#include "taut/plan/topology.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace taut {

namespace {

constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMaxEdgeTriangles = 1000;
constexpr double kMortonCells = 1u << 21;

/// One side of one triangle, or a link.
struct Side
{
    std::uint32_t high = 0;
    std::uint32_t triangle = kNoTriangle;
    bool operator<(const Side& o) const { return high != o.high ? high < o.high : triangle < o.triangle; }
    bool operator==(const Side&) const = default;
};

[[noreturn]] void refuse_side(const Mesh& mesh, std::uint32_t a, std::uint32_t b, const std::string& place)
{
    const std::size_t count = mesh.positions.size();
    if (a >= count || b >= count)
    {
        throw Error(ErrorCode::bad_input, place + " of the mesh names vertex " +
                                              std::to_string(std::max(a, b)) + ", but there are " +
                                              std::to_string(count) + " vertices");
    }
    throw Error(ErrorCode::bad_input, place + " of the mesh joins vertex " + std::to_string(a) +
                                          " to itself; its corners must be different vertices");
}

template <class Visit>
void for_each_side(const Mesh& mesh, Visit visit)
{
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    {
        const auto& corner = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k)
        {
            visit(corner[k], corner[(k + 1) % 3], t);
        }
    }
    for (const auto& link : mesh.links)
    {
        visit(link[0], link[1], kNoTriangle);
    }
    for (const auto& t : mesh.tetrahedra)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j)
                visit(t[i], t[j], kNoTriangle);
}

/// "triangles[7]": the element of a side, counted as for_each_side goes.
std::string place_of(const Mesh& mesh, std::size_t side)
{
    const std::size_t of_triangles = 3 * mesh.triangles.size(), of_links = mesh.links.size();
    if (side < of_triangles)
        return "triangles[" + std::to_string(side / 3) + "]";
    side -= of_triangles;
    if (side < of_links)
        return "links[" + std::to_string(side) + "]";
    return "tetrahedra[" + std::to_string((side - of_links) / 6) + "]";
}

void check_mesh(const Mesh& mesh)
{
    const std::size_t count = mesh.positions.size();
    std::size_t side = 0;
    for_each_side(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t) {
        if (a >= count || b >= count || a == b)
            refuse_side(mesh, a, b, place_of(mesh, side));
        ++side;
    });
}

/// The corner of a triangle that is neither a nor b.
std::uint32_t opposite(const Mesh& mesh, std::uint32_t triangle, std::uint32_t a, std::uint32_t b)
{
    for (const std::uint32_t corner : mesh.triangles[triangle])
    {
        if (corner != a && corner != b)
        {
            return corner;
        }
    }
    return a;
}

/// True if the triangle runs from a to b.
bool wound_along(const Mesh& mesh, std::uint32_t triangle, std::uint32_t a, std::uint32_t b)
{
    const auto& corner = mesh.triangles[triangle];
    return (corner[0] == a && corner[1] == b) || (corner[1] == a && corner[2] == b) ||
           (corner[2] == a && corner[0] == b);
}

/// Of the edge from a to b with the triangles `at` it.
void add_hinges(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> at,
                std::vector<Hinge>& out)
{
    if (at.size() > kMaxEdgeTriangles)
    {
        throw Error(ErrorCode::limit, "bodies: the edge between vertices " + std::to_string(a) + " and " +
                                          std::to_string(b) + " has " + std::to_string(at.size()) +
                                          " triangles; bending takes at most " +
                                          std::to_string(kMaxEdgeTriangles) + " at one edge");
    }
    for (std::size_t i = 0; i < at.size(); ++i)
    {
        const bool along = wound_along(mesh, at[i], a, b);
        const std::uint32_t wing0 = opposite(mesh, at[i], a, b);
        for (std::size_t j = i + 1; j < at.size(); ++j)
        {
            const std::uint32_t wing1 = opposite(mesh, at[j], a, b);
            if (wing0 != wing1)
            {
                out.push_back({along ? a : b, along ? b : a, wing0, wing1});
            }
        }
    }
}

/// Bits of a 21-bit number, two zeros after each.
std::uint64_t spread_bits(std::uint64_t x)
{
    x = (x | (x << 32)) & 0x001f00000000ffffull;
    x = (x | (x << 16)) & 0x001f0000ff0000ffull;
    x = (x | (x << 8)) & 0x100f00f00f00f00full;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3ull;
    return (x | (x << 2)) & 0x1249249249249249ull;
}

/// Cell of a coordinate; what is no number falls into cell 0.
std::uint64_t cell(double offset, double extent)
{
    const double scaled = offset / extent * kMortonCells;
    return scaled > 0 ? static_cast<std::uint64_t>(std::min(scaled, kMortonCells - 1)) : 0;
}

std::uint64_t morton_code(const glm::dvec3& offset, double extent)
{
    return spread_bits(cell(offset.x, extent)) | (spread_bits(cell(offset.y, extent)) << 1) |
           (spread_bits(cell(offset.z, extent)) << 2);
}

} // namespace

void each_edge(const Mesh& mesh, const EdgeVisit& visit)
{
    check_mesh(mesh);
    // Sides fall into one bucket a lower vertex, so that the sort is near-linear.
    std::vector<std::size_t> start(mesh.positions.size() + 1, 0);
    for_each_side(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t) {
        ++start[std::size_t(std::min(a, b)) + 1];
    });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Side> sides(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for_each_side(mesh, [&](std::uint32_t a, std::uint32_t b, std::uint32_t triangle) {
        sides[next[std::min(a, b)]++] = {std::max(a, b), triangle};
    });

    std::vector<std::uint32_t> triangles;
    for (std::uint32_t low = 0; low + 1 < start.size(); ++low)
    {
        const auto begin = sides.begin() + static_cast<std::ptrdiff_t>(start[low]);
        const auto end = sides.begin() + static_cast<std::ptrdiff_t>(start[low + 1]);
        std::sort(begin, end);
        for (auto side = begin; side != end;)
        {
            const std::uint32_t high = side->high;
            triangles.clear();
            for (; side != end && side->high == high; ++side)
                if (side->triangle != kNoTriangle)
                    triangles.push_back(side->triangle);
            visit(low, high, triangles);
        }
    }
}

std::vector<MeshEdge> mesh_edges(const Mesh& mesh)
{
    std::vector<MeshEdge> edges;
    each_edge(mesh, [&](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> triangles) {
        edges.push_back({a, b, {triangles.begin(), triangles.end()}});
    });
    return edges;
}

std::vector<Hinge> mesh_hinges(const Mesh& mesh)
{
    std::vector<Hinge> hinges;
    each_edge(mesh, [&](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> triangles) {
        add_hinges(mesh, a, b, triangles, hinges);
    });
    return hinges;
}

std::vector<std::uint32_t> locality_order(std::span<const glm::dvec3> positions)
{
    const double infinity = std::numeric_limits<double>::infinity();
    glm::dvec3 low(infinity), high(-infinity);
    for (const glm::dvec3& p : positions)
    {
        for (int axis = 0; axis < 3; ++axis) // comparisons that a NaN fails
        {
            low[axis] = p[axis] < low[axis] ? p[axis] : low[axis];
            high[axis] = p[axis] > high[axis] ? p[axis] : high[axis];
        }
    }
    const glm::dvec3 size = high - low;
    const double extent = std::max({size.x, size.y, size.z});

    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i)
    {
        keys[i] = {morton_code(positions[i] - low, extent), i};
    }
    std::sort(keys.begin(), keys.end()); // the index breaks ties, so this is stable
    std::vector<std::uint32_t> order(positions.size());
    std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
    return order;
}

} // namespace taut
