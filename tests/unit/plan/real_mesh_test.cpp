// Edges, hinges and colours of meshes that people made.

#include "support/skip.hpp"
#include "support/data.hpp"
#include "taut/plan/topology.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

using namespace taut;

namespace {

/// A reader for the tests alone, so that they do not depend on the scene's: OFF and OBJ triangles.
bool read_triangles(const std::string& name, Mesh& mesh)
{
    const auto path = data_folder() / "meshes" / name;
    std::ifstream in(path);
    if (!in)
    {
        TAUT_LEFT_OUT(path << " is missing");
        return false;
    }
    std::string word, line;
    if (path.extension() == ".off")
    {
        std::size_t vertices = 0, faces = 0, edges = 0, corners = 0;
        in >> word >> vertices >> faces >> edges;
        mesh.positions.resize(vertices);
        mesh.triangles.resize(faces);
        for (auto& p : mesh.positions)
        {
            in >> p.x >> p.y >> p.z;
        }
        for (auto& t : mesh.triangles)
        {
            in >> corners >> t[0] >> t[1] >> t[2];
        }
        return true;
    }
    while (std::getline(in, line))
    {
        std::istringstream words(line);
        glm::dvec3 p;
        std::array<std::uint32_t, 3> t{};
        words >> word;
        if (word == "v" && words >> p.x >> p.y >> p.z)
        {
            mesh.positions.push_back(p);
        }
        else if (word == "f")
        {
            for (auto& corner : t)
            {
                words >> word;
                corner = static_cast<std::uint32_t>(std::stoul(word) - 1);
            }
            mesh.triangles.push_back(t);
        }
    }
    return true;
}

ConstraintGraph graph_of(const std::vector<MeshEdge>& edges, std::size_t vertices)
{
    ConstraintGraph graph{static_cast<std::uint32_t>(vertices), 2, {}, {}};
    for (const MeshEdge& e : edges)
    {
        graph.vertices.insert(graph.vertices.end(), {e.a, e.b});
    }
    return graph;
}

ConstraintGraph graph_of(const std::vector<Hinge>& hinges, std::size_t vertices)
{
    ConstraintGraph graph{static_cast<std::uint32_t>(vertices), 4, {}, {}};
    for (const Hinge& h : hinges)
    {
        graph.vertices.insert(graph.vertices.end(), {h.edge0, h.edge1, h.wing0, h.wing1});
    }
    return graph;
}

std::uint32_t degree_of(const ConstraintGraph& graph)
{
    std::vector<std::uint32_t> degree(graph.vertex_count, 0);
    for (const std::uint32_t v : graph.vertices)
    {
        ++degree[v];
    }
    return *std::max_element(degree.begin(), degree.end());
}

} // namespace

TEST_CASE("real meshes have the edges that their description counts", "[topology][data]")
{
    struct Row
    {
        const char* file;
        std::size_t edges, boundary;
    };
    for (const Row& row : {Row{"armadillo.off", 78000, 0}, Row{"skirt_seamless_20k_cm.obj", 30597, 1197},
                           Row{"dress_stage.obj", 45098, 1828}, Row{"elephant-with-holes.off", 7371, 1353},
                           Row{"skirt8K.obj", 23979, 384}})
    {
        Mesh mesh;
        if (!read_triangles(row.file, mesh))
        {
            return;
        }
        INFO(row.file);
        const auto edges = mesh_edges(mesh);
        CHECK(edges.size() == row.edges);
        const auto boundary = std::count_if(edges.begin(), edges.end(),
                                            [](const MeshEdge& e) { return e.triangles.size() == 1; });
        CHECK(static_cast<std::size_t>(boundary) == row.boundary);
        CHECK(mesh_hinges(mesh).size() == row.edges - row.boundary);
    }
}

TEST_CASE("a real garment needs few colours, none of them small", "[topology][colouring][data]")
{
    Mesh mesh;
    if (!read_triangles("skirt_seamless_20k_cm.obj", mesh))
    {
        return;
    }
    for (const auto& graph : {graph_of(mesh_edges(mesh), mesh.positions.size()),
                              graph_of(mesh_hinges(mesh), mesh.positions.size())})
    {
        const Colouring plain = colour_greedy(graph, {64, false}), even = colour_greedy(graph);
        std::string why;
        CHECK(valid(plain, graph, &why));
        CHECK(why.empty());
        REQUIRE(valid(even, graph, &why));
        CHECK(even.hubs.empty());
        CHECK(even.colour_count() <= plain.colour_count());
        CHECK(even.colour_count() >= degree_of(graph));
        CHECK(even.colour_count() <= degree_of(graph) + 1);
        for (std::size_t k = 0; k < even.colour_count(); ++k)
        {
            const std::uint32_t size = even.colour_start[k + 1] - even.colour_start[k];
            CHECK(size * even.colour_count() > graph.size() * 9 / 10);
        }
    }
}
