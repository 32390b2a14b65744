// Where the warp of a fabric lies: along a direction or along the texture of a mesh file, and turned.

#include "support/catch.hpp"
#include "refusal.hpp"
#include "temporary.hpp"

#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>

using namespace taut;

namespace {

/// Two triangles in the plane z = 0; their texture is turned by 30 degrees, and stretched.
std::string square(bool second_has_texture = true)
{
    const double c = std::cos(glm::radians(30.0)), s = std::sin(glm::radians(30.0));
    std::string out = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
        out += "vt " + std::to_string(2 * (c * x + s * y)) + ' ' + std::to_string(5 * (c * y - s * x)) + '\n';
    return out + "f 1/1 2/2 3/3\n" + (second_has_texture ? "f 1/-4 3/-2 4/-1\n" : "f 1 3 4\n");
}

Scene scene(const std::string& file, const std::string& keys, const std::string& beside = "")
{
    return parse_scene(R"({"taut": 1, "bodies": [{"mesh": ")" + file + '"' + beside +
                       R"(, "material": {"fabric":
        {"warp": 1000, "weft": 900, "shear": 50)" +
                       keys + "}}}]}");
}

const std::string kTexture = R"(, "grain_of": "texture")";

void check_warp(const Scene& scene, const glm::dvec3& expected)
{
    const auto warp = scene_file::warp_directions(resolve(scene).bodies[0]);
    REQUIRE(warp.size() == 2);
    for (const glm::dvec3& along : warp)
        CHECK(glm::distance(along, expected) < 1e-5);
}

} // namespace

TEST_CASE("the warp follows the second texture coordinate of each triangle, and turns with the body")
{
    const Temporary folder;
    const std::string file = folder.write("square.obj", square()).string();
    const double a = glm::radians(30.0);
    check_warp(scene(file, kTexture), {-std::sin(a), std::cos(a), 0});
    check_warp(scene(file, kTexture + R"(, "grain_degrees": -30)"), {0, 1, 0});
    check_warp(scene(file, R"(, "grain": [1, 0, 0], "grain_degrees": 30)"), {std::cos(a), std::sin(a), 0});
    check_warp(scene(file, kTexture, R"(, "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 60}})"),
               {-1, 0, 0});
}

TEST_CASE("texture coordinates of PLY files, of vertices and of corners, are those of OBJ")
{
    const Temporary folder;
    const std::string vertices =
        folder
            .write("vertices.ply", "ply\nformat ascii 1.0\nelement vertex 4\n"
                                   "property float x\nproperty float s\nproperty float y\n"
                                   "property float z\nproperty float t\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n"
                                   "0 0 0 0 0\n1 0 0 0 1\n1 1 1 0 1\n0 1 1 0 0\n4 0 1 2 3\n")
            .string();
    check_warp(scene(vertices, kTexture), {1, 0, 0});
    const std::string corners =
        folder
            .write("corners.ply", "ply\nformat ascii 1.0\nelement vertex 4\n"
                                  "property float x\nproperty float y\nproperty float z\n"
                                  "element face 1\nproperty list uchar float texcoord\n"
                                  "property list uchar int vertex_indices\nend_header\n"
                                  "0 0 0\n1 0 0\n1 1 0\n0 1 0\n8 0 0 0 -1 1 -1 1 0 4 0 1 2 3\n")
            .string();
    check_warp(scene(corners, kTexture), {-1, 0, 0});
}

TEST_CASE("a warp that no texture gives is refused by name, and texture that nobody asks for may be anything")
{
    const Temporary folder;
    const auto why = [&](const std::string& text) {
        return refusal(scene(folder.write("mesh.obj", text).string(), kTexture));
    };
    CHECK(why(square()) == "nothing");
    CHECK(why(square(false)).find("triangle 1 of the body (vertices 0, 2, 3) has none") != std::string::npos);
    CHECK(why("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").find("the mesh has no texture") != std::string::npos);
    const std::string flat = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 1\nvt 2 2\nf 1/1 2/2 3/3\n";
    CHECK(why(flat).find("have no area") != std::string::npos);
    const std::string odd = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt nan\nvt one 2\nf 1/1 2/9 3/x/\n";
    CHECK(why(odd).find("has none") != std::string::npos);
    CHECK(refusal(scene(folder.write("mesh.obj", odd).string(), "")) == "nothing");
    const Scene grid =
        parse_scene(R"({"taut": 1, "bodies": [{"grid": {"cells": [2, 2]}, "material": {"fabric":
        {"warp": 1000, "weft": 900, "shear": 50, "grain_of": "texture"}}}]})");
    CHECK(refusal(grid).find("which has no texture coordinates") != std::string::npos);
}

TEST_CASE("a PLY of several lists of vertices and faces has texture where it has one, and none elsewhere")
{
    const Temporary folder;
    const std::string list = "property float x\nproperty float y\nproperty float z\n";
    const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n" + list +
                             "property float s\nproperty float t\nelement vertex 1\n" + list +
                             "element face 1\nproperty list uchar int vertex_indices\nelement face 1\n"
                             "property list uchar float texcoord\nproperty list uchar int vertex_indices\n"
                             "end_header\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0\n3 0 1 2\n"
                             "6 0 0 1 1 0 1 3 0 2 3\n";
    const Mesh mesh = read_mesh(folder.write("lists.ply", text), 0);
    REQUIRE(mesh.triangles.size() == 2);
    REQUIRE(mesh.texture.size() == 2);
    CHECK(mesh.texture[0][2] == glm::dvec2(1, 1));
    CHECK(mesh.texture[1][1] == glm::dvec2(1, 1));
    const std::string wrong = "ply\nformat ascii 1.0\nelement vertex 3\n" + list +
                              "property float s\nproperty float t\nelement vertex 1\n" + list +
                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                              "0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0\n3 1 2 3\n";
    CHECK(std::isnan(read_mesh(folder.write("wrong.ply", wrong), 0).texture.at(0)[2].x));
}
