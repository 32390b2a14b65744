#include "seeds.hpp"
#include "support/skip.hpp"
#include "support/data.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/weld.hpp"

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <glm/geometric.hpp>

#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <limits>

using namespace taut;

namespace {

Mesh parse(const std::string& extension, const std::string& text, double weld = 0,
           MeshFindings* findings = nullptr)
{
    MeshFindings found;
    Mesh mesh = scene_file::parse_mesh(text, extension, "file" + extension, weld, found);
    if (findings)
        *findings = found;
    return mesh;
}

std::string refusal(const std::string& extension, const std::string& text)
{
    try
    {
        parse(extension, text);
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        return error.what();
    }
    return "accepted";
}

std::filesystem::path mesh_folder() { return data_folder() / "meshes"; }

} // namespace

TEST_CASE("every format gives the same square")
{
    for (const seeds::Seed& file : seeds::meshes())
    {
        if (file.text.find("v 2 0 0") != std::string::npos || file.text.starts_with("OFF 5"))
            continue; // not the square
        INFO(file.extension << ' ' << file.text.substr(0, 40));
        MeshFindings findings;
        const Mesh mesh = parse("." + file.extension, file.text, 0, &findings);
        CHECK(mesh.positions == std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
        CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
        CHECK(findings.boundary_edges == 4);
        CHECK(findings.welded_vertices == (file.extension == "stl" ? 2 : 0));
        CHECK(findings.unused_vertices == 0);
    }
}

TEST_CASE("larger faces are fanned, negative indices count back, lines may be joined")
{
    const Mesh obj = parse(".OBJ", seeds::meshes()[1].text);
    CHECK(obj.triangles ==
          std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}});
    CHECK(parse(".off", "OFF 5 1 0\n0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n5 0 1 2 3 4\n").triangles ==
          std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
    CHECK(parse(".obj", "f 1 2 3\nv 0 0 0\r\nv 1 0 0\r\nv +1.5e-001 1e0 0\r\n").positions[2] ==
          glm::dvec3(0.15, 1, 0));
}

TEST_CASE("lines of an OBJ that may mean something and are not read are counted by kind")
{
    MeshFindings findings;
    parse(".obj",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\no cloth\ns off\nf 1 2 3\nl 1 2\nstitch 1 2\n"
          "stitch 2 3\n# stitch 1 3\n",
          0, &findings);
    CHECK(findings.skipped == std::map<std::string, std::size_t>{{"\"l\"", 1}, {"\"stitch\"", 2}});
}

TEST_CASE("of many kinds of lines that are not read, all lines are counted")
{
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (int kind = 10; kind < 48; ++kind)
        text += "kind" + std::to_string(kind) + " 1\n";
    MeshFindings findings;
    parse(".obj", text, 0, &findings);
    CHECK(findings.skipped.size() == 17);
    CHECK(findings.skipped["of further kinds"] == 22);
}

TEST_CASE("coordinates keep double precision")
{
    const Mesh mesh = parse(".obj", "v 0.1 0 0\nv 1.0000000000000002 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(mesh.positions[0].x == 0.1);
    CHECK(mesh.positions[1].x == 1.0000000000000002);
}

TEST_CASE("welding joins equal, near or no vertices, as asked")
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 -0\nv 1 1 0\nv 0 1.001 0\nf 1 2 3\nf 4 5 6\n";
    MeshFindings findings;
    CHECK(parse(".obj", text, -1, &findings).positions.size() == 6);
    CHECK(findings.boundary_edges == 6);
    CHECK(parse(".obj", text, 0, &findings).positions.size() == 5);
    CHECK(findings.welded_vertices == 1);
    const Mesh mesh = parse(".obj", text, 0.01, &findings);
    CHECK(mesh.triangles == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 3, 2}});
    CHECK(mesh.positions[2] == glm::dvec3(0, 1, 0)); // the first of the two stays
    CHECK(findings.welded_vertices == 2);
    CHECK(findings.boundary_edges == 4);
}

TEST_CASE("welding by distance agrees with comparing every pair")
{
    std::vector<glm::dvec3> points;
    std::uint64_t state = 1;
    const auto random = [&] {
        return double((state = state * 6364136223846793005ull + 1442695040888963407ull) >> 40) / (1 << 24);
    };
    for (int i = 0; i < 1500; ++i)
        points.emplace_back(random() - 0.5, random() - 0.5, 0.2 * random());
    const double distance = 0.04;
    std::vector<std::uint32_t> expected(points.size());
    for (std::uint32_t v = 0; v < points.size(); ++v)
    {
        expected[v] = v;
        for (std::uint32_t u = 0; u < v && expected[v] == v; ++u)
            if (expected[u] == u && glm::distance(points[u], points[v]) <= distance)
                expected[v] = u;
    }
    CHECK(scene_file::weld_targets(points, distance) == expected);
    const std::vector<glm::dvec3> far = {{1e20, 0, 0}, {1e20, 0, 1e-12}, {1e20, 0, 0}};
    CHECK(scene_file::weld_targets(far, 1e-300) == std::vector<std::uint32_t>{0, 1, 0});
}

TEST_CASE("triangles without area are dropped and numbered as in the file")
{
    MeshFindings findings;
    const Mesh mesh = parse(".obj",
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 9 9 9\n"
                            "f 1 1 2\nf 1 2 3\nf 1 2 4\nf 3 2 2\n",
                            0, &findings);
    CHECK(mesh.triangles.size() == 1);
    CHECK(findings.degenerate_triangles == std::vector<std::uint32_t>{0, 2, 3});
    CHECK(findings.unused_vertices == 2); // the one of the flat triangle and the lonely one
    CHECK(mesh.positions.size() == 3);
}

TEST_CASE("triangles that stand twice, either way round, are dropped and numbered as in the file")
{
    MeshFindings findings;
    const Mesh mesh = parse(".obj",
                            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 1 0\n"
                            "f 1 2 3\nf 2 4 3\nf 2 3 1\nf 3 2 1\nf 5 2 4\n",
                            0, &findings);
    CHECK(mesh.triangles.size() == 2);
    CHECK(findings.repeated_triangles == std::vector<std::uint32_t>{2, 3, 4}); // the last after welding
    CHECK(findings.non_manifold_edges.empty());
    CHECK(findings.boundary_edges == 4);
}

TEST_CASE("degenerate or not does not depend on the unit of length")
{
    for (const double unit : {1e-25, 1.0, 1e25})
    {
        scene_file::RawMesh raw;
        for (const glm::dvec3& p :
             {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1e-9, 0), glm::dvec3(2, 0, 0)})
            raw.positions.push_back(unit * p);
        raw.triangles = {{0, 1, 2}, {0, 1, 3}};
        MeshFindings findings;
        CHECK(scene_file::clean(raw, 0, findings).triangles.size() == 1);
        CHECK(findings.degenerate_triangles == std::vector<std::uint32_t>{1});
    }
}

TEST_CASE("edges of more than two triangles are named")
{
    MeshFindings findings;
    parse(".off", "OFF 5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n", 0, &findings);
    CHECK(findings.non_manifold_edges == std::vector<std::array<std::uint32_t, 2>>{{0, 1}});
    CHECK(findings.boundary_edges == 6);
}

TEST_CASE("a refused mesh file is told by name, place, what is there and what would be right")
{
    CHECK_THAT(refusal(".obj", "v 0 0 nan\n"),
               Contains("file.obj: line 1: z is \"nan\"; it must be a finite number"));
    CHECK_THAT(refusal(".obj", "v 0 0\nv"), Contains("line 1: z is nothing"));
    CHECK_THAT(refusal(".obj", "v 0 0 1e999\n"), Contains("finite"));
    CHECK_THAT(refusal(".obj", "v 0 0 1e31\nv 0 1 0\nv 1 0 0\nf 1 2 3"),
               Contains("vertex 0 is [0, 0, 1e+31]"));
    CHECK_THAT(refusal(".obj", "v 0 0 0\nf 1 0 1\n"),
               Contains("line 2: a corner of a face is \"0\"; vertices are numbered from 1"));
    CHECK_THAT(refusal(".obj", "v 0 0 0\nf 1 -2 1\n"), Contains("\"-2\""));
    CHECK_THAT(refusal(".obj", "v 0 0 0\nf 1 2 1\n"), Contains("names vertex 2; the file has 1"));
    CHECK_THAT(refusal(".obj", "v 0 0 0\nf 1 1\n"), Contains("has 2 corners; it needs 3 or more"));
    CHECK_THAT(refusal(".obj", "v 0 0 0\n"), Contains("1 vertices and no triangle"));
    CHECK_THAT(refusal(".off", "OOF\n3 1 0\n"), Contains("starts with \"OOF\"; an OFF file starts with OFF"));
    CHECK_THAT(refusal(".off", "OFF\n4000000000 1 0\n0 0 0\n"), Contains("is 4000000000; the"));
    CHECK_THAT(refusal(".off", "OFF\n1 -1 0\n0 0 0\n"), Contains("number of faces is -1"));
    CHECK_THAT(refusal(".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
               Contains("line 6: a face names vertex 3; the file has 3"));
    CHECK_THAT(refusal(".off", "OFF\n2 1 0\n0 0 0\n1 0 0 # 3 0 1 2\n"), Contains("ends after 0 of 1 faces"));
    CHECK_THAT(refusal(".off", "OFF BINARY\n"), Contains("convert"));
    CHECK_THAT(refusal(".ply", "ply\nformat ascii 2.0\nend_header"), Contains("no line \"end_header\""));
    CHECK_THAT(refusal(".ply", "ply\nelement vertex 1\nend_header\n"), Contains("lacks the line \"format\""));
    CHECK_THAT(
        refusal(".ply", "ply\nformat ascii 1.0\nelement vertex 9999999999\nproperty float x\nend_header\n0"),
        Contains("announces 9999999999 of \"vertex\""));
    CHECK_THAT(refusal(".ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty half x\nend_header\n"),
               Contains("\"half\""));
    CHECK_THAT(refusal(".stl", "not stl"), Contains("it has 7 bytes"));
    CHECK_THAT(refusal(".stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n"),
               Contains("line 4: a coordinate is \"zero\""));
    std::string huge = seeds::binary_stl();
    huge[83] = '\x40';
    CHECK_THAT(refusal(".stl", huge), Contains("announces 1073741826 triangles"));
    CHECK_THAT(refusal(".gltf", "x"), Contains("must be .obj, .ply, .off or .stl"));
}

TEST_CASE("a mesh file that is missing, or a folder, is an io error that names it")
{
    const Temporary folder;
    std::filesystem::create_directory(folder.path / "folder.obj");
    for (const char* name : {"missing.obj", "folder.obj"})
        try
        {
            read_mesh(folder.path / name, 0);
            FAIL("no error");
        }
        catch (const Error& error)
        {
            CHECK(error.code() == ErrorCode::io);
            CHECK_THAT(error.what(), Contains((folder.path / name).string()));
        }
}

TEST_CASE("a binary STL whose header starts with solid is read as binary")
{
    std::string text = seeds::binary_stl();
    text.replace(0, 5, "solid");
    CHECK(parse(".stl", text).triangles.size() == 2);
}

namespace {

struct Known
{
    const char* file;
    std::size_t vertices, triangles, duplicates, boundary_edges;
};

// Counted by another program; see the README.md of the data. `vertices` before welding.
constexpr Known kKnown[] = {
    {"skirt_seamless_20k_cm.obj", 10598, 19999, 0, 1197},
    {"skirt8K.obj", 8121, 15858, 0, 384},
    {"dress_stage.obj", 15656, 29456, 0, 1828},
    {"armadillo.off", 26002, 52000, 0, 0},
    {"elephant-with-holes.off", 2798, 4463, 65, 1353},
    {"elephant.off", 2775, 5558, 0, 0},
    {"ChineseDragon-10kv.off", 10000, 19994, 0, 6},
    {"mannequin-devil.off", 12977, 25888, 0, 64},
    {"camel.off", 9770, 19536, 0, 0},
    {"bunny_10k.obj", 5002, 10000, 0, 0},
    {"spot_low_resolution.obj", 829, 1654, 0, 0},
    {"man.off", 17495, 34986, 0, 0},
};

} // namespace

TEST_CASE("real meshes have the counts that another program found")
{
    if (!std::filesystem::exists(mesh_folder()))
    {
        TAUT_LEFT_OUT("no folder " << mesh_folder() << "; set TAUT_DATA to the folder of shared data");
        return;
    }
    for (const Known& known : kKnown)
    {
        INFO(known.file);
        MeshFindings findings;
        const Mesh mesh = read_mesh(mesh_folder() / known.file, 0, &findings);
        CHECK(mesh.positions.size() + findings.welded_vertices == known.vertices);
        CHECK(findings.welded_vertices == known.duplicates);
        CHECK(mesh.triangles.size() == known.triangles);
        CHECK(findings.boundary_edges == known.boundary_edges);
        CHECK(findings.non_manifold_edges.empty());
        CHECK(findings.degenerate_triangles.empty());
        CHECK(findings.unused_vertices == 0);
    }
}

TEST_CASE("an independent reader finds the same triangles in real OBJ files")
{
    if (!std::filesystem::exists(mesh_folder()))
    {
        TAUT_LEFT_OUT("no folder " << mesh_folder() << "; set TAUT_DATA to the folder of shared data");
        return;
    }
    for (const char* name : {"skirt_seamless_20k_cm.obj", "dress_stage.obj", "bunny_10k.obj"})
    {
        const Mesh mesh = read_mesh(mesh_folder() / name, -1);
        Assimp::Importer importer;
        const aiScene* scene = importer.ReadFile((mesh_folder() / name).string(), 0);
        REQUIRE(scene != nullptr);
        std::size_t t = 0, different = 0;
        for (unsigned m = 0; m < scene->mNumMeshes; ++m)
            for (unsigned f = 0; f < scene->mMeshes[m]->mNumFaces; ++f, ++t)
                for (unsigned c = 0; c < 3; ++c)
                {
                    const aiVector3D p =
                        scene->mMeshes[m]->mVertices[scene->mMeshes[m]->mFaces[f].mIndices[c]];
                    const glm::dvec3 q =
                        t < mesh.triangles.size() ? mesh.positions[mesh.triangles[t][c]] : glm::dvec3(1e9);
                    different += glm::distance(q, glm::dvec3(p.x, p.y, p.z)) > 1e-6 * (1 + glm::length(q));
                }
        CHECK(t == mesh.triangles.size());
        CHECK(different == 0);
    }
}
